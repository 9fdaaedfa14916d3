#include <algorithm>
#include <numbers>

#include "geometry/solids/bodies.hpp"
#include "geometry/solids/sections.hpp"

namespace navjit {
namespace {

std::vector<kernels::SideGroup<double>> by_eight(
    const std::vector<kernels::SideNormal<double>>& sides) {
  std::vector<kernels::SideGroup<double>> groups;
  for (std::size_t i = 0; i < sides.size(); i += 8) {
    groups.push_back(
        {detail::eight_from(i, sides.size(), [&](std::size_t k) { return sides[k].x; }),
         detail::eight_from(i, sides.size(), [&](std::size_t k) { return sides[k].y; })});
  }
  return groups;
}

struct Holder : detail::SectionsHolder<kernels::Polyhedra<double>> {
  std::vector<kernels::SideNormal<double>> sides;
  std::vector<kernels::SideGroup<double>> groups;

  Holder(detail::Sections&& made, const kernels::Wedge<double>& wedge,
         std::vector<kernels::SideNormal<double>>&& normals, double edge_factor)
      : SectionsHolder(std::move(made), wedge), sides(std::move(normals)) {
    shape.sides = sides.data();
    shape.side_count = static_cast<int>(sides.size());
    groups = by_eight(sides);
    shape.groups = groups.data();
    shape.group_count = static_cast<int>(groups.size());
    // The sides' planes reach further than their edges only outside the segment.
    shape.rmax = sections.rmax * edge_factor;
  }
};

struct Turns {
  kernels::Wedge<double> wedge;
  double step, edge_factor;
};
Turns make_turns(int sides, double start_phi, double delta_phi, const std::string& name) {
  detail::require(sides >= 1 && sides <= 100000, name, "a polyhedra needs 1 to 100000 sides");
  const kernels::Wedge<double> wedge = detail::make_wedge(start_phi, delta_phi, name);
  if (wedge.kind == 0) delta_phi = 2 * std::numbers::pi;
  const double step = delta_phi / sides;
  detail::require(step < std::numbers::pi * (1 - 1e-9), name,
                  "each side of a polyhedra must span less than 180 degrees");
  return {wedge, step, 1 / std::cos(step / 2)};
}

/// Up to so many planes, two groups of them, are asked faster than sides.
constexpr std::size_t most_planes = 16;

/// The planes of a single section that is convex, the ends first, as for extruded solids; none if
/// it is not convex, or has too many planes.
std::vector<kernels::Plane<double>> convex_planes(
    const detail::Sections& sections, const kernels::Wedge<double>& wedge,
    const std::vector<kernels::SideNormal<double>>& sides) {
  const kernels::Section<double>& section = sections.sections.front();
  const std::size_t count = 2 + sides.size() + (wedge.kind == 0 ? 0 : 2);
  if (sections.sections.size() > 1 || section.bored != 0 || wedge.kind == 2 ||
      count > most_planes) {
    return {};
  }
  const kernels::ConicalFace<double>& face = section.outer;
  std::vector<kernels::Plane<double>> planes{{0, 0, -1, section.z_low}, {0, 0, 1, -section.z_high}};
  if (wedge.kind == 1) planes.push_back({wedge.start_y, -wedge.start_x, 0, 0});
  for (const kernels::SideNormal<double>& n : sides) {
    planes.push_back({face.cosine * n.x, face.cosine * n.y, -face.slope,
                      face.slope * section.z_low - face.radius});
  }
  if (wedge.kind == 1) planes.push_back({-wedge.end_y, wedge.end_x, 0, 0});
  return planes;
}

/// `planes` give the extent.
Solid polyhedra(std::string name, detail::Sections&& sections, std::span<const ZPlane> planes,
                int sides, double start_phi, const Turns& turns) {
  const double step = turns.step, edge_factor = turns.edge_factor;
  std::vector<kernels::SideNormal<double>> normals;
  for (int i = 0; i < sides; ++i) {
    const detail::UnitVector n = detail::unit_vector(start_phi + (i + 0.5) * step);
    normals.push_back({n.x, n.y});
  }
  Extent e{{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
  for (int i = 0; i <= sides; ++i) {
    const detail::UnitVector edge = detail::unit_vector(start_phi + i * step);
    for (const ZPlane& plane : planes) {
      for (const double r : {plane.rmin * edge_factor, plane.rmax * edge_factor}) {
        const Vec3 corner{r * edge.x, r * edge.y, plane.z};
        e = merged(e, {corner, corner});
      }
    }
  }
  std::vector<kernels::Plane<double>> faces = convex_planes(sections, turns.wedge, normals);
  if (!faces.empty()) return detail::make_hull(std::move(name), std::move(faces), e);
  const auto holder = std::make_shared<const Holder>(std::move(sections), turns.wedge,
                                                     std::move(normals), edge_factor);
  return {std::move(name), SolidKind::polyhedra,
          std::shared_ptr<const void>(holder, &holder->shape), e};
}

}  // namespace

Solid make_polyhedra(std::string name, std::span<const ZPlane> planes, int sides, double start_phi,
                     double delta_phi) {
  const Turns turns = make_turns(sides, start_phi, delta_phi, name);
  detail::Sections sections = detail::make_sections(planes, name);
  return polyhedra(std::move(name), std::move(sections), planes, sides, start_phi, turns);
}

Solid make_generic_polyhedra(std::string name, std::span<const ContourPoint> contour, int sides,
                             double start_phi, double delta_phi) {
  const Turns turns = make_turns(sides, start_phi, delta_phi, name);
  std::vector<ContourPoint> across;
  std::vector<ZPlane> planes;
  for (const ContourPoint& p : contour) {
    across.push_back({p.r / turns.edge_factor, p.z});
    planes.push_back({p.z, across.back().r, across.back().r});
  }
  detail::Sections sections = detail::make_sections(across, name);
  return polyhedra(std::move(name), std::move(sections), planes, sides, start_phi, turns);
}

double SolidFacts<kernels::Polyhedra<double>>::volume(const Shape& s) {
  return detail::sections_volume(
      s, s.side_count * std::tan(detail::angle_of(s.wedge) / (2 * s.side_count)));
}

Round SolidFacts<kernels::Polyhedra<double>>::round(const Shape& s) {
  return detail::round_sections(s);
}

}  // namespace navjit
