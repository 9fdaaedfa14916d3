#include "geometry/model/order.hpp"

namespace navjit {
namespace {

// Recursion goes as deep as the tree, which is bounded.
void visit(const World& world, VolumeId volume, std::vector<bool>& seen,
           std::vector<VolumeId>& order) {
  if (seen[volume]) return;
  seen[volume] = true;
  for (const Placement& placement : world.volumes[volume].daughters) {
    visit(world, placement.volume, seen, order);
  }
  order.push_back(volume);
}

}  // namespace

std::vector<VolumeId> daughters_first(const World& world) {
  std::vector<bool> seen(world.volumes.size());
  std::vector<VolumeId> order;
  visit(world, world.top, seen, order);
  return order;
}

}  // namespace navjit
