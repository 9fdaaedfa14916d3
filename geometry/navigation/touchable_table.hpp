// Frames of touchables by number, where there are few enough of them: for a track that is brought
// to another touchable they are found there, and none is composed. After S. Wenzel et al.,
// "Accelerating navigation in the VecGeom geometry modeller", section 3.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/navigation/navigation_stack.hpp"

namespace navjit {

class Geometry;

/// Immutable. The bits are the same as those of pushing a touchable's levels one by one.
class TouchableTable {
 public:
  /// With more touchables there is no table: it takes 40 bytes for each, and 72 for a rotation.
  static constexpr TouchableId most = 1 << 19;

  TouchableTable() = default;
  explicit TouchableTable(const Geometry& geometry);

  bool empty() const { return touchables_.empty(); }
  /// Brings the stack, whose innermost level has `touchable` in its tree, to this touchable.
  void descend(NavigationStack& stack, TouchableId touchable) const;

 private:
  struct Touchable {
    double translation[3];
    std::uint32_t mother;
    std::uint32_t rotation;  ///< 0: that of its mother; else 1 + the number of its own
    std::uint32_t volume, daughter;
  };
  static_assert(sizeof(Touchable) == 40);

  std::vector<Touchable> touchables_;
  std::vector<std::array<double, 9>> rotations_;
};

}  // namespace navjit
