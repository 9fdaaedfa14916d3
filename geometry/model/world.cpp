#include "geometry/model/world.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/model/daughter_holding.hpp"
#include "geometry/solids/extent.hpp"

namespace navjit {
namespace {

constexpr TouchableId max_touchables = TouchableId{1} << 62;

/// A volume whose daughters are being visited.
struct Visit {
  VolumeId volume;
  std::size_t next = 0;
};

[[noreturn]] void throw_cycle(const World& world, const std::vector<Visit>& stack, VolumeId again) {
  auto visit =
      std::find_if(stack.begin(), stack.end(), [&](const Visit& v) { return v.volume == again; });
  std::string path;
  for (int shown = 0; visit != stack.end() && shown < 8; ++visit, ++shown) {
    path += world.volumes[visit->volume].name + " -> ";
  }
  if (visit != stack.end()) path += "... -> ";
  throw GeometryError("volumes contain one another: " + path + world.volumes[again].name);
}

/// Volumes reachable from the top, each after all its daughters. A loop and no recursion, since a
/// hostile chain of volumes may be longer than the call stack allows.
std::vector<VolumeId> daughters_first(const World& world) {
  enum class State : char { unseen, open, done };
  std::vector<State> states(world.volumes.size(), State::unseen);
  std::vector<VolumeId> order;
  std::vector<Visit> stack{{world.top}};
  states[world.top] = State::open;
  while (!stack.empty()) {
    Visit& visit = stack.back();
    const auto& daughters = world.volumes[visit.volume].daughters;
    if (visit.next == daughters.size()) {
      states[visit.volume] = State::done;
      order.push_back(visit.volume);
      stack.pop_back();
      continue;
    }
    const VolumeId daughter = daughters[visit.next++].volume;
    if (states[daughter] == State::open) throw_cycle(world, stack, daughter);
    if (states[daughter] == State::unseen) {
      states[daughter] = State::open;
      stack.push_back({daughter});
    }
  }
  return order;
}

void check_references(const World& world) {
  if (world.top >= world.volumes.size()) throw GeometryError("the world volume does not exist");
  for (const LogicalVolume& volume : world.volumes) {
    for (const Placement& placement : volume.daughters) {
      if (placement.volume >= world.volumes.size()) {
        throw GeometryError("placement '" + placement.name + "' in volume '" + volume.name +
                            "' is of a volume that does not exist");
      }
    }
  }
}

}  // namespace

void finish(World& world) {
  check_references(world);
  std::vector<int> depths(world.volumes.size(), 0);
  for (LogicalVolume& volume : world.volumes) volume.touchables = 0;
  for (const VolumeId id : daughters_first(world)) {
    LogicalVolume& volume = world.volumes[id];
    volume.touchables = 1;
    depths[id] = 1;
    for (Placement& placement : volume.daughters) {
      placement.offset = volume.touchables;
      volume.touchables += world.volumes[placement.volume].touchables;
      if (volume.touchables > max_touchables) {
        throw GeometryError("volume '" + volume.name + "' holds more than 2^62 touchables");
      }
      depths[id] = std::max(depths[id], 1 + depths[placement.volume]);
    }
  }
  if (depths[world.top] > max_depth) {
    throw GeometryError("the tree of volumes is " + std::to_string(depths[world.top]) +
                        " levels deep; at most " + std::to_string(max_depth) + " are navigated");
  }
  world.depth = depths[world.top];
  const double size = largest_coordinate(world.volumes[world.top].solid.extent);
  world.tolerance = std::max(world.tolerance_rule.absolute, world.tolerance_rule.relative * size);
}

bool is_finished(const World& world) {
  if (world.depth < 1 || world.depth > max_depth || !(world.tolerance > 0) ||
      world.top >= world.volumes.size() || world.volumes[world.top].touchables == 0) {
    return false;
  }
  for (const LogicalVolume& volume : world.volumes) {
    if (volume.touchables == 0) continue;  // not reached from the top
    // A daughter's tree is smaller than its mother's: where all sums are right there is no cycle.
    TouchableId sum = 1;
    for (const Placement& placement : volume.daughters) {
      if (placement.volume >= world.volumes.size() || placement.offset != sum) return false;
      const TouchableId below = world.volumes[placement.volume].touchables;
      if (below == 0 || below >= volume.touchables) return false;
      sum += below;
    }
    if (sum != volume.touchables || volume.solid.shape == nullptr) return false;
  }
  return true;
}

void require_finished(const World* world) {
  if (world == nullptr) throw GeometryError("there is no detector: the pointer is null");
  if (!is_finished(*world)) {
    throw GeometryError(
        "the detector is not ready to be navigated: call navjit::finish after its last change");
  }
}

std::string path_of(const World& world, TouchableId touchable) {
  const LogicalVolume* volume = &world.volumes.at(world.top);
  if (touchable >= volume->touchables) {
    throw UsageError("the world has no touchable " + std::to_string(touchable));
  }
  std::string path = volume->name;
  while (touchable > 0) {
    const Placement& placement = volume->daughters[daughter_holding(volume->daughters, touchable)];
    path += '/' + placement.name;
    touchable -= placement.offset;
    volume = &world.volumes[placement.volume];
  }
  return path;
}

}  // namespace navjit
