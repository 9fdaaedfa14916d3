#include "geometry/navigation/geometry.hpp"

#include <cmath>

#include "geometry/bvh/box_tree.hpp"

namespace navjit {

Scene::Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene::~Scene() = default;
Geometry::~Geometry() = default;

Extent placed_extent(const Solid& solid, const Transformation& t) {
  const Extent& e = solid.extent;
  const double centre[3] = {(e.min.x + e.max.x) / 2, (e.min.y + e.max.y) / 2,
                            (e.min.z + e.max.z) / 2};
  const double half[3] = {(e.max.x - e.min.x) / 2, (e.max.y - e.min.y) / 2,
                          (e.max.z - e.min.z) / 2};
  double low[3], high[3];
  for (int i = 0; i < 3; ++i) {
    double c = t.translation[i], h = 0;
    for (int j = 0; j < 3; ++j) {
      c += t.rotation[3 * j + i] * centre[j];
      h += std::abs(t.rotation[3 * j + i]) * half[j];
    }
    low[i] = c - h;
    high[i] = c + h;
  }
  return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
}

namespace {

/// Below this number of daughters each is tested without a box: a guess, not yet measured.
constexpr std::size_t boxes_from = 4;

Search choose(std::size_t daughters, GeometryOptions::Force force) {
  if (daughters == 0) return Search::none;
  switch (force) {
    case GeometryOptions::Force::all:
      return Search::all;
    case GeometryOptions::Force::linear_boxes:
      return Search::linear_boxes;
    case GeometryOptions::Force::bvh:
      return Search::bvh;
    case GeometryOptions::Force::automatic:
      break;
  }
  if (daughters < boxes_from) return Search::all;
  return bvh::default_method(daughters) == bvh::Method::linear ? Search::linear_boxes : Search::bvh;
}

}  // namespace

Geometry::Geometry(std::shared_ptr<const World> world, const GeometryOptions& options)
    : world_(std::move(world)) {
  std::size_t total = 0;
  for (const LogicalVolume& volume : world_->volumes) total += volume.daughters.size();
  daughters_.reserve(total);  // spans into it are taken below
  scenes_.resize(world_->volumes.size());
  for (std::size_t v = 0; v < scenes_.size(); ++v) {
    const LogicalVolume& volume = world_->volumes[v];
    Scene& scene = scenes_[v];
    scene.solid = volume.solid.any();
    const std::size_t first = daughters_.size();
    std::vector<Extent> boxes;
    for (const Placement& placement : volume.daughters) {
      const Solid& solid = world_->volumes[placement.volume].solid;
      daughters_.push_back(
          {solid.any(), placement.transformation, placement.offset, placement.volume});
      boxes.push_back(placed_extent(solid, placement.transformation));
    }
    scene.daughters = std::span(daughters_).subspan(first);
    scene.search = choose(scene.daughters.size(), options.force);
    if (scene.search == Search::linear_boxes || scene.search == Search::bvh) {
      scene.boxes = std::make_unique<const bvh::BoxTree>(
          boxes, world_->tolerance,
          scene.search == Search::linear_boxes ? bvh::Method::linear : bvh::Method::two_level);
    }
  }
}

}  // namespace navjit
