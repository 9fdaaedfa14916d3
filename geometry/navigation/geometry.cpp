#include "geometry/navigation/geometry.hpp"

#include <algorithm>

#include "geometry/bvh/box_tree.hpp"
#include "geometry/model/placed_extent.hpp"

namespace navjit {

Scene::Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene::~Scene() = default;
Geometry::~Geometry() = default;

namespace {

/// With fewer daughters than this each is tested without a box: a guess, not yet measured.
constexpr std::size_t boxes_from = 4;

/// The box structure of a scene; nothing for a scene that is searched without one.
std::optional<bvh::Structure> choose(const LogicalVolume& volume, const GeometryOptions& options) {
  using Force = GeometryOptions::Force;
  const std::size_t daughters = volume.daughters.size();
  if (daughters == 0 || options.force == Force::all) return {};
  const auto named = options.boxes_of.find(volume.name);
  if (named != options.boxes_of.end()) return named->second;
  if (options.force == Force::linear_boxes) return bvh::Structure{};
  if (options.force == Force::bvh) {
    return options.boxes.value_or(bvh::Structure{bvh::Method::two_level});
  }
  if (daughters < boxes_from) return {};
  return options.boxes.value_or(bvh::default_method(daughters));
}

void check_names(const World& world, const GeometryOptions& options) {
  for (const auto& [name, structure] : options.boxes_of) {
    if (std::none_of(world.volumes.begin(), world.volumes.end(),
                     [&](const LogicalVolume& volume) { return volume.name == name; })) {
      throw GeometryError("a box structure is asked for '" + name +
                          "', but no logical volume is called so; navjit inspect lists them");
    }
  }
}

Extent well_inside_of(const World& world) {
  const Solid& solid = world.volumes[world.top].solid;
  if (solid.kind != SolidKind::box) return {{1, 1, 1}, {-1, -1, -1}};
  const double within = 2 * world.tolerance;
  const Extent& e = solid.extent;
  return {{e.min.x + within, e.min.y + within, e.min.z + within},
          {e.max.x - within, e.max.y - within, e.max.z - within}};
}

}  // namespace

Geometry::Geometry(std::shared_ptr<const World> world, const GeometryOptions& options)
    : world_(std::move(world)), well_inside_{} {
  require_finished(world_.get());
  well_inside_ = well_inside_of(*world_);
  check_names(*world_, options);
  std::size_t total = 0;
  for (const LogicalVolume& volume : world_->volumes) total += volume.daughters.size();
  daughters_.reserve(total);  // spans of it are taken below
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
    const std::optional<bvh::Structure> structure = choose(volume, options);
    if (structure) {
      scene.boxes =
          std::make_unique<const bvh::BoxTree>(boxes, box_margin(world_->tolerance), *structure);
      scene.search = structure->method == bvh::Method::linear ? Search::linear_boxes : Search::bvh;
    } else if (!scene.daughters.empty()) {
      scene.search = Search::all;
    }
    if (options.force == GeometryOptions::Force::automatic) {
      scene.neighbour_lists =
          find_neighbours(volume.solid, boxes, scene.boxes.get(), world_->tolerance);
    }
  }
  packed_ = PackedScenes(scenes_);
  if (options.force == GeometryOptions::Force::automatic) touchables_ = TouchableTable(*this);
}

}  // namespace navjit
