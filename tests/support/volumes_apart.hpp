// The same detector with a volume of its own for every copy, as it is written by programs that give
// each copy a name.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "geometry/model/world.hpp"

namespace navjit::tests {

/// Every placement gets a volume of its own, except placements of volumes in `stay`.
inline World volumes_apart(const World& from, const std::vector<VolumeId>& stay = {}) {
  World world;
  std::vector<VolumeId> same(from.volumes.size(), ~VolumeId{0});
  const auto copy = [&](const auto& self, VolumeId volume) -> VolumeId {
    const bool stays = std::find(stay.begin(), stay.end(), volume) != stay.end();
    if (stays && same[volume] != ~VolumeId{0}) return same[volume];
    const auto id = static_cast<VolumeId>(world.volumes.size());
    same[volume] = id;
    LogicalVolume own = from.volumes[volume];
    own.name += "_" + std::to_string(id);
    own.daughters.clear();
    world.volumes.push_back(std::move(own));
    for (Placement placement : from.volumes[volume].daughters) {
      placement.volume = self(self, placement.volume);
      world.volumes[id].daughters.push_back(std::move(placement));
    }
    return id;
  };
  world.top = copy(copy, from.top);
  finish(world);
  return world;
}

}  // namespace navjit::tests
