#include "geometry/check/overlaps.hpp"

#include <algorithm>
#include <map>

#include "geometry/bvh/box_tree_traversal.hpp"
#include "geometry/check/surface.hpp"

namespace navjit {
namespace {

/// The deepest finding of each pair of one volume.
class Findings {
 public:
  explicit Findings(VolumeId volume) : volume_(volume) {}

  void add(std::uint32_t a, std::uint32_t b, const Vec3& point, double depth) {
    if (b != Overlap::mother && b < a) std::swap(a, b);
    const auto [entry, fresh] = deepest_.try_emplace({a, b}, Overlap{volume_, a, b, point, depth});
    if (!fresh && depth > entry->second.depth) entry->second = {volume_, a, b, point, depth};
  }
  void append_to(std::vector<Overlap>& all) const {
    for (const auto& [pair, overlap] : deepest_) all.push_back(overlap);
  }

 private:
  VolumeId volume_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Overlap> deepest_;
};

void check_scene(const Geometry& geometry, VolumeId volume, const OverlapOptions& options,
                 std::vector<Overlap>& all) {
  const World& world = geometry.world();
  const Scene& scene = geometry.scene(volume);
  if (scene.daughters.empty()) return;
  std::vector<Extent> boxes;
  for (const Daughter& d : scene.daughters) {
    boxes.push_back(placed_extent(world.volumes[d.volume].solid, d.transformation));
  }
  const bvh::BoxTree tree(boxes, world.tolerance, bvh::default_method(boxes.size()));
  std::map<const void*, std::vector<Vec3>> surfaces;  // placed many times, sampled once
  Findings findings(volume);
  for (std::uint32_t k = 0; k < scene.daughters.size(); ++k) {
    const Daughter& daughter = scene.daughters[k];
    const Solid& solid = world.volumes[daughter.volume].solid;
    auto& points = surfaces[solid.shape.get()];
    if (points.empty()) {
      points = surface_points(solid, options.resolution, world.tolerance, options.seed);
    }
    for (const Vec3& local : points) {
      const Vec3 p = to_outer(daughter.transformation, local);
      if (inside(scene.solid, p, options.tolerance) == Side::outside) {
        // Safety may be less than the depth, and 0 for awkward shapes: outside by the tolerance is
        // what is known then.
        findings.add(k, Overlap::mother, p,
                     std::max(options.tolerance, safety_to_in(scene.solid, p)));
      }
      tree.containing(p, [&](std::uint32_t j) {
        if (j == k) return true;
        const Daughter& other = scene.daughters[j];
        const Vec3 q = to_local(other.transformation, p);
        if (inside(other.solid, q, options.tolerance) == Side::inside) {
          findings.add(k, j, p, std::max(options.tolerance, safety_to_out(other.solid, q)));
        }
        return true;
      });
    }
  }
  findings.append_to(all);
}

}  // namespace

std::vector<Overlap> find_overlaps(const Geometry& geometry, const OverlapOptions& options) {
  std::vector<Overlap> all;
  for (VolumeId v = 0; v < geometry.size(); ++v) {
    if (geometry.world().volumes[v].touchables > 0) check_scene(geometry, v, options, all);
  }
  return all;
}

}  // namespace navjit
