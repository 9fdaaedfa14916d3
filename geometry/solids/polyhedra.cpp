#include <algorithm>
#include <numbers>

#include "geometry/solids/sections.hpp"

namespace navjit {
namespace {

struct Holder : detail::StackHolder<kernels::Polyhedra<double>> {
  std::vector<kernels::SideNormal<double>> sides;

  Holder(detail::Sections&& made, const kernels::Wedge<double>& wedge,
         std::vector<kernels::SideNormal<double>>&& normals, double edge_factor)
      : StackHolder(std::move(made), wedge), sides(std::move(normals)) {
    shape.sides = sides.data();
    shape.side_count = static_cast<int>(sides.size());
    // Outside the segment the sides' planes may reach further than its edges do, but only there.
    shape.rmax = sections.rmax * edge_factor;
  }
};

}  // namespace

Solid make_polyhedra(std::string name, std::span<const ZPlane> planes, int sides, double start_phi,
                     double delta_phi) {
  detail::require(sides >= 1 && sides <= 100000, name, "a polyhedra needs 1 to 100000 sides");
  const kernels::Wedge<double> wedge = detail::make_wedge(start_phi, delta_phi, name);
  if (wedge.kind == 0) delta_phi = 2 * std::numbers::pi;
  const double step = delta_phi / sides;
  detail::require(step < std::numbers::pi * (1 - 1e-9), name,
                  "each side of a polyhedra must span less than 180 degrees");
  std::vector<kernels::SideNormal<double>> normals;
  for (int i = 0; i < sides; ++i) {
    const detail::UnitVector n = detail::unit_vector(start_phi + (i + 0.5) * step);
    normals.push_back({n.x, n.y});
  }
  const double edge_factor = 1 / std::cos(step / 2);
  const auto holder = std::make_shared<const Holder>(detail::make_sections(planes, name), wedge,
                                                     std::move(normals), edge_factor);
  Extent e{{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
  for (int i = 0; i <= sides; ++i) {
    const detail::UnitVector edge = detail::unit_vector(start_phi + i * step);
    for (const ZPlane& plane : planes) {
      for (const double r : {plane.rmin * edge_factor, plane.rmax * edge_factor}) {
        const Vec3 corner{r * edge.x, r * edge.y, plane.z};
        e = detail::merged(e, {corner, corner});
      }
    }
  }
  return {std::move(name), SolidKind::polyhedra,
          std::shared_ptr<const void>(holder, &holder->shape), e};
}

}  // namespace navjit
