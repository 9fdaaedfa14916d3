// How far rays go in which volumes of a detector, and from where to where.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "geometry/model/world.hpp"
#include "geometry/rays/ray.hpp"
#include "navjit/observation.hpp"

namespace navjit {

/// A node is a volume within a volume, and so on from the world down. All touchables that are
/// reached through the same volumes are one node. Node 0 is the world; mothers come before
/// daughters.
struct PassedNode {
  std::uint32_t mother = 0;
  VolumeId volume = 0;
  std::uint32_t depth = 0;
};

/// How much of a ray is in touchables of a node.
struct PassedLength {
  std::uint32_t node = 0, ray = 0;
  double length = 0;  ///< mm
};

/// How many steps of all rays end on boundaries between touchables of two nodes.
struct PassedBoundaries {
  std::uint32_t from = 0, to = 0;
  std::uint32_t common = 0;  ///< depth of the deepest touchable that holds both
  std::uint64_t count = 0;
};

struct Passages {
  std::vector<PassedNode> nodes;
  std::vector<PassedLength> lengths;         ///< by node, then by ray
  std::vector<PassedBoundaries> boundaries;  ///< by `from`
  std::size_t rays = 0;
};

/// `count` of the rays that an observation names.
std::vector<Ray> sample(const World& world, const Observation::Rays& rays, std::uint64_t count,
                        std::uint64_t seed);

/// Follows the rays through the world, which must be finished. A ray that begins outside the world
/// passes nothing.
Passages pass_through(const std::shared_ptr<const World>& world, std::span<const Ray> rays);

}  // namespace navjit
