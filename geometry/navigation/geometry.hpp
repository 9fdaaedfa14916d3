// The world prepared for navigation: for each volume a compact scene with its search structure.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/bvh/structure.hpp"
#include "geometry/model/daughter_holding.hpp"
#include "geometry/model/world.hpp"
#include "geometry/navigation/navigation_stack.hpp"
#include "geometry/navigation/neighbours.hpp"
#include "geometry/navigation/packed_scenes.hpp"
#include "geometry/navigation/touchable_table.hpp"
#include "navjit/search.hpp"

namespace navjit {

namespace bvh {
class BoxTree;
}

/// A placed daughter.
struct Daughter {
  kernels::AnySolid<double> solid;
  Transformation transformation;
  TouchableId offset;
  VolumeId volume;
};

/// One logical volume with its daughters.
struct Scene {
  kernels::AnySolid<double> solid;
  std::span<const Daughter> daughters;
  Search search = Search::none;
  std::unique_ptr<const bvh::BoxTree> boxes;  ///< for linear_boxes and bvh
  NeighbourLists neighbour_lists;             ///< empty where they are not used

  Scene();
  Scene(Scene&&) noexcept;
  ~Scene();
};

/// Immutable, shared by all threads. Keeps the world alive.
class Geometry {
 public:
  /// Throws GeometryError if the options name a volume that does not exist.
  explicit Geometry(std::shared_ptr<const World> world, const GeometryOptions& options = {});
  Geometry(const Geometry&) = delete;
  Geometry& operator=(const Geometry&) = delete;
  ~Geometry();

  const World& world() const { return *world_; }
  std::shared_ptr<const World> share_world() const { return world_; }
  const Scene& scene(VolumeId volume) const { return scenes_[volume]; }
  /// The same, as the generic navigator reads it.
  const PackedScene& packed(VolumeId volume) const { return packed_[volume]; }
  /// The daughter of the volume whose tree holds the touchable that is `below` > 0 after it.
  std::size_t daughter_holding(VolumeId volume, TouchableId below) const {
    const PackedScene& scene = packed_[volume];
    return navjit::daughter_holding(std::span(scene.daughters, scene.count), below,
                                    packed_.daughters_per_touchable(volume));
  }
  std::size_t size() const { return scenes_.size(); }
  double tolerance() const { return world_->tolerance; }
  /// A box, mm, that is all in the world and farther from its surface than the tolerance; empty
  /// where the world is no box.
  const Extent& well_inside() const { return well_inside_; }
  /// The table is empty where there are too many touchables.
  const TouchableTable& touchables() const { return touchables_; }

 private:
  std::shared_ptr<const World> world_;
  std::vector<Daughter> daughters_;
  std::vector<Scene> scenes_;
  PackedScenes packed_;
  TouchableTable touchables_;
  Extent well_inside_;
};

}  // namespace navjit
