// Remembers safeties that were asked for a short time ago.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "navjit/state.hpp"

namespace navjit::geant4 {

/// Remembers the safeties of recent points, found by the exact bits of the point. Geant4 asks for
/// the safety of a point twice, one call after the other; and secondaries start where steps of
/// their parents ended, some time ago. What was asked last is not looked for in the table, which is
/// mostly not in the nearest cache.
class KnownSafeties {
 public:
  /// The safety, mm, if this was asked for last; else negative.
  double last(const State& state, const Vec3& point) const { return last_.at(state, point); }
  /// The safety, mm; negative if none is known. From now on it counts as asked for last.
  double find(const State& state, const Vec3& point) {
    const Entry& entry = entries_[slot(point)];
    const double known = entry.at(state, point);
    if (known >= 0) last_.set(point, state.touchable(), known);
    return known;
  }
  void add(const State& state, const Vec3& point, double safety) {
    last_.set(point, state.touchable(), safety);
    entries_[slot(point)].set(point, state.touchable(), safety);
  }
  void clear() {
    last_ = {};
    entries_.assign(entries_.size(), Entry{});
  }

 private:
  struct Entry {
    Vec3 point{std::numeric_limits<double>::quiet_NaN(), 0, 0};
    TouchableId touchable = 0;
    double safety = -1;

    /// Number by number: a copy of all at once would load what was just stored in parts, and wait.
    void set(const Vec3& where, TouchableId in, double known) {
      point.x = where.x;
      point.y = where.y;
      point.z = where.z;
      touchable = in;
      safety = known;
    }
    double at(const State& state, const Vec3& where) const {
      return point == where && touchable == state.touchable() ? safety : -1;
    }
  };
  static constexpr int bits = 10;

  static std::size_t slot(const Vec3& p) {
    const auto mixed = std::bit_cast<std::uint64_t>(p.x) * 0x9e3779b97f4a7c15U +
                       std::bit_cast<std::uint64_t>(p.y) * 0xc2b2ae3d27d4eb4fU +
                       std::bit_cast<std::uint64_t>(p.z) * 0x165667b19e3779f9U;
    return mixed >> (64 - bits);
  }

  Entry last_{};
  std::vector<Entry> entries_ = std::vector<Entry>(std::size_t{1} << bits);
};

}  // namespace navjit::geant4
