#include "codegen/data/inner.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/model/placed_extent.hpp"
#include "geometry/solids/extent.hpp"

namespace navjit::codegen {
namespace {

/// The range of distances from the z axis of a placed solid's points, mm.
struct Radii {
  double least, most;
};
Radii radii_of(const Solid& solid, const Transformation& t) {
  const double away = std::hypot(t.translation[0], t.translation[1]);
  if (solid.kind == SolidKind::tube && !t.rotated) {
    const auto& tube = *static_cast<const kernels::Tube<double>*>(solid.shape.get());
    return {tube.rmin - away, tube.rmax + away};
  }
  const Extent box = placed_extent(solid, t);
  const double x = std::max(std::abs(box.min.x), std::abs(box.max.x));
  const double y = std::max(std::abs(box.min.y), std::abs(box.max.y));
  const double near_x = std::max({0.0, box.min.x, -box.max.x});
  const double near_y = std::max({0.0, box.min.y, -box.max.y});
  return {std::hypot(near_x, near_y), std::hypot(x, y)};
}

/// Whether all of the placed solid is deeper in the mother than the margin; false if that is not
/// known.
bool is_deep(const Solid& mother, const Solid& solid, const Transformation& t, double margin) {
  const Extent box = placed_extent(solid, t);
  if (mother.kind == SolidKind::tube) {
    const auto& tube = *static_cast<const kernels::Tube<double>*>(mother.shape.get());
    const Extent deep = inflated(mother.extent, -margin);
    if (tube.wedge.kind == 0 && box.min.z > deep.min.z && box.max.z < deep.max.z) {
      const Radii radii = radii_of(solid, t);
      return radii.most < tube.rmax - margin &&
             (tube.rmin == 0 || radii.least > tube.rmin + margin);
    }
  }
  return holds_deep(mother, box, margin);
}

}  // namespace

kernels::InnerDaughters inner_of(const Geometry& geometry, VolumeId volume) {
  const World& world = geometry.world();
  const LogicalVolume& v = world.volumes[volume];
  if (v.daughters.empty()) return kernels::no_daughters;
  // The margin is far above the error of a computed distance to a surface.
  const double margin = 1e-5 * largest_coordinate(v.solid.extent) + 10 * geometry.tolerance();
  const bool deep =
      std::all_of(v.daughters.begin(), v.daughters.end(), [&](const Placement& placement) {
        return is_deep(v.solid, world.volumes[placement.volume].solid, placement.transformation,
                       margin);
      });
  return deep ? kernels::deep_daughters : kernels::has_surface_daughters;
}

std::vector<kernels::InnerDaughters> inner_of_daughters(const Geometry& geometry,
                                                        const Scene& scene) {
  std::map<VolumeId, kernels::InnerDaughters> known;
  std::vector<kernels::InnerDaughters> inner;
  inner.reserve(scene.daughters.size());
  for (const Daughter& d : scene.daughters) {
    const auto [at, fresh] = known.try_emplace(d.volume);
    if (fresh) at->second = inner_of(geometry, d.volume);
    inner.push_back(at->second);
  }
  return inner;
}

}  // namespace navjit::codegen
