// What a simulation holds of the navigation: small values.
#pragma once

#include <cstddef>
#include <functional>

#include "geometry/model/vector.hpp"
#include "geometry/model/world.hpp"

namespace navjit {

/// Where a track is: a touchable, or outside the world. Copied, compared and hashed freely; valid
/// for the world it came from. World::path_of prints it.
class State {
 public:
  State() = default;
  State(TouchableId touchable, VolumeId volume) : touchable_(touchable), volume_(volume) {}

  bool inside() const { return touchable_ != outside; }
  TouchableId touchable() const { return touchable_; }
  /// The logical volume, an index into World::volumes; undefined outside the world.
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

}  // namespace navjit

template <>
struct std::hash<navjit::State> {
  std::size_t operator()(const navjit::State& state) const noexcept {
    return std::hash<navjit::TouchableId>{}(state.touchable());
  }
};
