#include "geometry/detector/touchables.hpp"

#include "geometry/model/daughter_holding.hpp"
#include "geometry/navigation/navigation_stack.hpp"
#include "navjit/errors.hpp"

namespace navjit {
namespace {

[[noreturn]] void throw_other_detector() { throw UsageError("the state is of another detector"); }

}  // namespace

void check_state(const World& world, const State& state) {
  if (!state.inside()) throw UsageError("the state is outside the world");
  if (state.touchable() >= world.volumes[world.top].touchables ||
      state.volume() >= world.volumes.size()) {
    throw_other_detector();
  }
}

TouchableLevels levels_of(const World& world, const State& state) {
  check_state(world, state);
  TouchableLevels levels;
  levels.push_back({0, world.top, 0});
  while (levels.back().touchable != state.touchable()) {
    const TouchableLevel at = levels.back();
    const auto& daughters = world.volumes[at.volume].daughters;
    const std::size_t k = daughter_holding(daughters, state.touchable() - at.touchable);
    levels.push_back(
        {at.touchable + daughters[k].offset, daughters[k].volume, static_cast<std::uint32_t>(k)});
  }
  if (levels.back().volume != state.volume()) throw_other_detector();
  return levels;
}

Transformation frame_of(const World& world, const TouchableLevels& levels) {
  NavigationStack stack;
  enter_world(stack, world.top);
  for (std::size_t i = 1; i < levels.size(); ++i) {
    const Placement& placement = world.volumes[levels[i - 1].volume].daughters[levels[i].daughter];
    push(stack, placement.transformation, placement.volume, levels[i].daughter, placement.offset);
  }
  return frame_of(stack.levels[stack.depth]);
}

}  // namespace navjit
