// The world prepared for navigation: per volume a compact scene with its acceleration structure.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/bvh/structure.hpp"
#include "geometry/model/world.hpp"
#include "geometry/navigation/stack.hpp"
#include "geometry/navigation/surroundings.hpp"

namespace navjit {

namespace bvh {
class BoxTree;
}

/// How a scene's daughters are searched.
enum class Search : std::uint8_t { none, all, linear_boxes, bvh };

/// A daughter as the navigator meets it.
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
  Surroundings surroundings;                  ///< empty where they are not used

  Scene();
  Scene(Scene&&) noexcept;
  ~Scene();
};

struct GeometryOptions {
  /// Forces one search for all scenes with daughters, for tests and measurements. All but
  /// `automatic` search on leaving a daughter, too, without surroundings.
  enum class Force : std::uint8_t { automatic, all, linear_boxes, bvh } force = Force::automatic;
  /// The box structure of all scenes that have enough daughters for one, whatever their number;
  /// nothing: bvh::default_method. Changes no answer.
  std::optional<bvh::Structure> boxes{};
  /// The same for single volumes by name, few daughters or many. Boxes where there were none may
  /// make safeties larger, never too large.
  std::map<std::string, bvh::Structure> boxes_of{};
};

/// Immutable, shared by all threads. Keeps the world alive.
class Geometry {
 public:
  /// Throws GeometryError if the options name a volume that is not there.
  explicit Geometry(std::shared_ptr<const World> world, const GeometryOptions& options = {});
  Geometry(const Geometry&) = delete;
  Geometry& operator=(const Geometry&) = delete;
  ~Geometry();

  const World& world() const { return *world_; }
  std::shared_ptr<const World> share_world() const { return world_; }
  const Scene& scene(VolumeId volume) const { return scenes_[volume]; }
  std::size_t size() const { return scenes_.size(); }
  double tolerance() const { return world_->tolerance; }

 private:
  std::shared_ptr<const World> world_;
  std::vector<Daughter> daughters_;
  std::vector<Scene> scenes_;
};

/// The box around a placed solid in its mother's frame, mm.
Extent placed_extent(const Solid& solid, const Transformation& transformation);

}  // namespace navjit
