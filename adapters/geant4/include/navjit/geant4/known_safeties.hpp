// Safeties that were asked for not long ago.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "navjit/state.hpp"

namespace navjit::geant4 {

/// Remembers the safeties of recent points, found by the point's very bits: secondaries start where
/// their parents' steps ended, and Geant4 asks for the safety of a point more than once.
class KnownSafeties {
 public:
  /// mm; negative where none is known.
  double find(const State& state, const Vec3& point) const {
    const Entry& entry = entries_[slot(point)];
    return entry.point == point && entry.touchable == state.touchable() ? entry.safety : -1;
  }
  void add(const State& state, const Vec3& point, double safety) {
    entries_[slot(point)] = {point, state.touchable(), safety};
  }
  void clear() { entries_.assign(entries_.size(), Entry{}); }

 private:
  struct Entry {
    Vec3 point{std::numeric_limits<double>::quiet_NaN(), 0, 0};
    TouchableId touchable = 0;
    double safety = -1;
  };
  static constexpr int bits = 10;

  static std::size_t slot(const Vec3& p) {
    const auto mixed = std::bit_cast<std::uint64_t>(p.x) * 0x9e3779b97f4a7c15U +
                       std::bit_cast<std::uint64_t>(p.y) * 0xc2b2ae3d27d4eb4fU +
                       std::bit_cast<std::uint64_t>(p.z) * 0x165667b19e3779f9U;
    return mixed >> (64 - bits);
  }

  std::vector<Entry> entries_ = std::vector<Entry>(std::size_t{1} << bits);
};

}  // namespace navjit::geant4
