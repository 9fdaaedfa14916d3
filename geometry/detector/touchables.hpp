// Touchables as ways down the tree of placements.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/model/world.hpp"
#include "navjit/state.hpp"

namespace navjit {

/// One level of the way to a touchable.
struct TouchableLevel {
  TouchableId touchable;
  VolumeId volume;
  std::uint32_t daughter;  ///< its number in the mother; 0 for the world volume

  State state() const { return {touchable, volume}; }
};

/// The levels from the world volume down to a touchable.
class TouchableLevels {
 public:
  void push_back(const TouchableLevel& level) { levels_[size_++] = level; }
  std::size_t size() const { return size_; }
  const TouchableLevel& operator[](std::size_t depth) const { return levels_[depth]; }
  const TouchableLevel& back() const { return levels_[size_ - 1]; }

 private:
  std::array<TouchableLevel, max_depth> levels_;
  std::size_t size_ = 0;
};

/// Throws UsageError if the state is outside the world, or if the world does not have so many
/// touchables or volumes.
void check_state(const World& world, const State& state);

/// Throws UsageError also if the touchable is of another volume than the state says.
TouchableLevels levels_of(const World& world, const State& state);

/// The frame of the last level in the world: the bits that the navigation stack holds.
Transformation frame_of(const World& world, const TouchableLevels& levels);

}  // namespace navjit
