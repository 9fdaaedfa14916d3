// What a simulation keeps of the navigation: small values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "navjit/detail/api.hpp"
#include "navjit/vector.hpp"

namespace NAVJIT_API navjit {

/// The number of a logical volume, below Detector::volumes().
using VolumeId = std::uint32_t;
/// The number of a touchable in the detector's tree, counted in preorder: the world volume is 0,
/// and a daughter comes after the trees of the daughters before it.
using TouchableId = std::uint64_t;

/// Where a track is: a touchable, or outside the world. Copied, compared and hashed freely; good in
/// every thread and every Navigator of the detector that it came from. Detector tells what it is.
class State {
 public:
  /// Outside the world.
  State() = default;
  /// For programs that have stored both numbers.
  State(TouchableId touchable, VolumeId volume) : touchable_(touchable), volume_(volume) {}

  /// Whether it is in the world.
  bool inside() const { return touchable_ != outside; }
  /// Its number in the tree; outside the world, a value that is the number of no touchable.
  TouchableId touchable() const { return touchable_; }
  /// The logical volume; undefined outside the world.
  VolumeId volume() const { return volume_; }

  friend bool operator==(const State& a, const State& b) { return a.touchable_ == b.touchable_; }

 private:
  static constexpr TouchableId outside = ~TouchableId{0};
  TouchableId touchable_ = outside;
  VolumeId volume_ = 0;
};

/// The answer to a step.
struct Step {
  double length;  ///< mm, >= 0, at most the limit
  bool boundary;  ///< whether a boundary ended it (also where it falls together with the limit)
  State next;     ///< where the track is then: fully located
};

/// A ball in which there is nothing but the volume of one state: within it nothing has to be asked.
struct SafetySphere {
  State state{};
  Vec3 centre{0, 0, 0};  ///< mm
  double radius = 0;     ///< mm; a lower bound of the distance from the centre to any boundary

  /// A lower bound of the distance from the point to any boundary, mm; 0 for other states and for
  /// points outside the ball.
  double safety(const State& at, const Vec3& point) const {
    if (!(at == state)) return 0;
    const double left = radius - norm(point - centre);
    return left > 0 ? left : 0;
  }

  /// Whether a step of `length` mm from the point stays in the ball, whatever its direction. But
  /// for rounding, a comparison with safety() says the same, but waits for a square root. False for
  /// other states and for points outside the ball. A step as long as the radius is in it.
  bool holds(const State& at, const Vec3& point, double length) const {
    const Vec3 from_centre = point - centre;
    const double left = radius - length;
    return (at == state) & (radius > 0) & (length >= 0) & (left >= 0) &
           (dot(from_centre, from_centre) <= left * left);
  }
};

}  // namespace navjit

template <>
struct std::hash<navjit::State> {
  std::size_t operator()(const navjit::State& state) const noexcept {
    return std::hash<navjit::TouchableId>{}(state.touchable());
  }
};
