#include "geometry/check/overlaps.hpp"

#include <algorithm>
#include <map>

#include "geometry/bvh/box_tree_traversal.hpp"
#include "geometry/check/aimed.hpp"
#include "geometry/check/surface.hpp"
#include "geometry/model/placed_extent.hpp"
#include "geometry/solids/extent.hpp"

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
  bool has(std::uint32_t a, std::uint32_t b) const { return deepest_.contains({a, b}); }
  void append_to(std::vector<Overlap>& all) const {
    for (const auto& [pair, overlap] : deepest_) all.push_back(overlap);
  }

 private:
  VolumeId volume_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Overlap> deepest_;
};

/// Indices of daughters whose boxes along the mother's axes share more than the tolerance.
std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_to_check(
    const std::vector<Extent>& boxes, const bvh::BoxTree& tree, double tolerance) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    const Extent& a = boxes[i];
    tree.overlapping(a, [&](std::uint32_t k) {
      if (k <= i) return true;
      if (share_more_than(tolerance, a, boxes[k])) pairs.emplace_back(i, k);
      return true;
    });
  }
  return pairs;
}

void check_scene(const Geometry& geometry, VolumeId volume, const OverlapOptions& options,
                 OverlapReport& report) {
  const World& world = geometry.world();
  const Scene& scene = geometry.scene(volume);
  if (scene.daughters.empty()) return;
  std::vector<Extent> boxes;
  for (const Daughter& d : scene.daughters) {
    boxes.push_back(placed_extent(world.volumes[d.volume].solid, d.transformation));
  }
  const bvh::BoxTree tree(boxes, world.tolerance, bvh::default_method(boxes.size()));
  std::map<const void*, SolidPoints> sampled;  // a solid that is placed many times is sampled once
  Findings findings(volume);
  for (std::uint32_t k = 0; k < scene.daughters.size(); ++k) {
    const Daughter& daughter = scene.daughters[k];
    const Solid& solid = world.volumes[daughter.volume].solid;
    const auto [found, fresh] = sampled.try_emplace(solid.shape.get());
    SolidPoints& points = found->second;
    if (fresh) points = sample_points(solid, options.resolution, world.tolerance, options.seed);
    if (points.surface.empty()) report.not_sampled.emplace_back(volume, k);
    // `depth` is how deep the point is in the daughter itself.
    const auto check_point = [&](const Vec3& local, double depth) {
      const Vec3 p = to_outer(daughter.transformation, local);
      if (inside(scene.solid, p, options.tolerance) == Side::outside) {
        // The safety may be less than the depth, and 0 for awkward shapes. Then all that is known
        // is that the point is outside by the tolerance.
        findings.add(k, Overlap::mother, p,
                     std::max(options.tolerance, depth + safety_to_in(scene.solid, p)));
      }
      tree.containing(p, [&](std::uint32_t j) {
        if (j == k) return true;
        const Daughter& other = scene.daughters[j];
        const Vec3 q = to_local(other.transformation, p);
        if (inside(other.solid, q, options.tolerance) == Side::inside) {
          findings.add(k, j, p, std::max(options.tolerance, depth + safety_to_out(other.solid, q)));
        }
        return true;
      });
    };
    for (const Vec3& p : points.surface) check_point(p, 0);
    for (const Vec3& p : corner_points(solid, options.tolerance)) check_point(p, 0);
    for (const Vec3& p : points.interior) {
      if (inside(daughter.solid, p, options.tolerance) != Side::inside) continue;
      check_point(p, safety_to_out(daughter.solid, p));
    }
  }
  // A daughter that fills a part of the mother's bore has points there, and on the mother's
  // surface.
  const Solid& mother = world.volumes[volume].solid;
  const auto check_hole = [&](const Vec3& p) {
    tree.containing(p, [&](std::uint32_t k) {
      const Vec3 q = to_local(scene.daughters[k].transformation, p);
      if (inside(scene.daughters[k].solid, q, options.tolerance) != Side::inside) return true;
      const double depth = safety_to_out(scene.daughters[k].solid, q);
      const bool beyond = inside(scene.solid, p, options.tolerance) == Side::outside;
      findings.add(
          k, Overlap::mother, p,
          std::max(options.tolerance, depth + (beyond ? safety_to_in(scene.solid, p) : 0)));
      return true;
    });
  };
  for (const Vec3& p :
       sample_points(mother, options.resolution, world.tolerance, options.seed).surface) {
    check_hole(p);
  }
  for (const Vec3& p : bore_points(mother, options.tolerance)) check_hole(p);
  const SolidKind kind = mother.kind;
  const bool has_no_hole = kind == SolidKind::box || kind == SolidKind::trd ||
                           kind == SolidKind::hull || kind == SolidKind::orb;
  const std::size_t lines = has_no_hole ? 0 : std::min<std::size_t>(options.resolution, 512);
  for (std::uint32_t k = 0; k < scene.daughters.size(); ++k) {
    if (findings.has(k, Overlap::mother)) continue;
    const Daughter& d = scene.daughters[k];
    const auto beyond = find_point_beyond({world.volumes[d.volume].solid, d.transformation}, mother,
                                          lines, options.tolerance, world.tolerance, options.seed);
    if (beyond) findings.add(k, Overlap::mother, beyond->point, beyond->depth);
  }
  for (const auto& [i, k] : pairs_to_check(boxes, tree, options.tolerance)) {
    if (findings.has(i, k)) continue;
    const Daughter &a = scene.daughters[i], &b = scene.daughters[k];
    const PlacedSolid first{world.volumes[a.volume].solid, a.transformation};
    const PlacedSolid second{world.volumes[b.volume].solid, b.transformation};
    if (!boxes_meet(first, second, options.tolerance)) continue;
    const std::size_t lines_of_pair = std::min<std::size_t>(options.resolution, 64);
    const auto shared = find_shared_point(first, second, lines_of_pair, options.tolerance,
                                          world.tolerance, options.seed);
    if (shared) findings.add(i, k, shared->point, shared->depth);
  }
  findings.append_to(report.overlaps);
}

}  // namespace

OverlapReport check_overlaps(const Geometry& geometry, const OverlapOptions& options) {
  OverlapReport report;
  for (VolumeId v = 0; v < geometry.size(); ++v) {
    if (geometry.world().volumes[v].touchables > 0) check_scene(geometry, v, options, report);
  }
  return report;
}

}  // namespace navjit
