#include "geometry/navigation/touchable_table.hpp"

#include <algorithm>
#include <memory>

#include "geometry/navigation/geometry.hpp"

namespace navjit {

TouchableTable::TouchableTable(const Geometry& geometry) {
  const World& world = geometry.world();
  const TouchableId count = world.volumes[world.top].touchables;
  if (count > most) return;
  touchables_.reserve(count);
  const auto stack = std::make_unique<NavigationStack>();
  enter_world(*stack, world.top);
  const auto keep = [&](std::uint32_t mother) {
    const StackLevel& level = stack->levels[stack->depth];
    Touchable& t = touchables_.emplace_back();
    std::copy_n(level.translation, 3, t.translation);
    t.mother = mother;
    t.rotation = 0;
    t.volume = level.volume;
    t.daughter = level.daughter;
    if (level.rotation != level.own_rotation) return;
    std::copy_n(level.own_rotation, 9, rotations_.emplace_back().begin());
    t.rotation = static_cast<std::uint32_t>(rotations_.size());
  };
  keep(0);
  // Visits them in preorder, which is the order of their numbers.
  std::vector<std::size_t> next{0};  // the next daughter to visit, for each level
  while (!next.empty()) {
    const StackLevel& level = stack->levels[stack->depth];
    const auto daughters = geometry.scene(level.volume).daughters;
    const auto mother = static_cast<std::uint32_t>(level.touchable);
    if (next.back() == daughters.size()) {
      next.pop_back();
      --stack->depth;
      continue;
    }
    const Daughter& d = daughters[next.back()];
    push(*stack, d.transformation, d.volume, static_cast<unsigned>(next.back()), d.offset);
    ++next.back();
    keep(mother);
    next.push_back(0);
  }
}

void TouchableTable::descend(NavigationStack& stack, TouchableId touchable) const {
  std::uint32_t way[kernels::stack_levels];
  int length = 0;
  const auto from = static_cast<std::uint32_t>(stack.levels[stack.depth].touchable);
  for (auto t = static_cast<std::uint32_t>(touchable); t != from; t = touchables_[t].mother) {
    way[length++] = t;
  }
  while (length > 0) {
    const std::uint32_t number = way[--length];
    const Touchable& t = touchables_[number];
    const double* mothers = stack.levels[stack.depth].rotation;
    StackLevel& level = stack.levels[++stack.depth];
    std::copy_n(t.translation, 3, level.translation);
    level.rotation = mothers;
    if (t.rotation != 0) {
      std::copy_n(rotations_[t.rotation - 1].begin(), 9, level.own_rotation);
      level.rotation = level.own_rotation;
    }
    level.touchable = number;
    level.volume = t.volume;
    level.daughter = t.daughter;
  }
}

}  // namespace navjit
