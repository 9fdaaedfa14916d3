// The pieces that solids are divided into, by the conventions of Geant4's G4PVDivision if they keep
// within the solid (docs/gdml.md).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/gdml/structure.hpp"

namespace navjit::gdml {
namespace {

bool has_planes(const DivisibleShape& s) { return !s.planes.empty(); }

/// The planes with z rising; fails if they turn back.
std::vector<ZPlane> rising(std::vector<ZPlane> planes, const std::string_view& tag) {
  if (planes.front().z > planes.back().z) std::reverse(planes.begin(), planes.end());
  const bool turns = std::adjacent_find(planes.begin(), planes.end(),
                                        [](auto& a, auto& b) { return a.z > b.z; }) != planes.end();
  if (turns) {
    throw GeometryError("a " + std::string(tag) + " whose planes turn back in z is not divided");
  }
  return planes;
}

ZPlane between(const ZPlane& a, const ZPlane& b, double z) {
  const double part = (z - a.z) / (b.z - a.z);
  return {z, a.rmin + part * (b.rmin - a.rmin), a.rmax + part * (b.rmax - a.rmax)};
}

/// The planes from z1 to z2; the outermost ones are cut there if need be.
std::vector<ZPlane> cut_planes(const std::vector<ZPlane>& planes, double z1, double z2) {
  const double slight = 1e-12 * std::max({std::abs(planes.front().z), std::abs(planes.back().z)});
  std::vector<ZPlane> cut;
  for (std::size_t i = 0; i + 1 < planes.size(); ++i) {
    const ZPlane &a = planes[i], &b = planes[i + 1];
    if (!(a.z < z2 - slight && b.z > z1 + slight)) continue;
    const ZPlane from = a.z < z1 - slight ? between(a, b, z1) : a;
    const ZPlane to = b.z > z2 + slight ? between(a, b, z2) : b;
    if (cut.empty() || !(cut.back() == from)) cut.push_back(from);
    if (a.z < b.z) cut.push_back(to);
  }
  return cut;
}

/// Cuts along z, from z1 to z2 as the file counts its planes.
void cut_along_z(DivisibleShape& s, double z1, double z2) {
  if (has_planes(s)) {
    s.planes = cut_planes(rising(s.planes, s.tag), z1, z2);
    for (ZPlane& plane : s.planes) plane.z -= (z1 + z2) / 2;
    return;
  }
  const DivisibleShape whole = s;
  s.hz = (z2 - z1) / 2;
  if (s.tag != "cone" && s.tag != "trd") return;
  const auto at = [&](double low, double high, double z) {
    return low + (high - low) * ((z + whole.hz) / (2 * whole.hz));
  };
  s.x1 = at(whole.x1, whole.x2, z1), s.x2 = at(whole.x1, whole.x2, z2);
  s.y1 = at(whole.y1, whole.y2, z1), s.y2 = at(whole.y1, whole.y2, z2);
  s.rmin1 = at(whole.rmin1, whole.rmin2, z1), s.rmin2 = at(whole.rmin1, whole.rmin2, z2);
  s.rmax1 = at(whole.rmax1, whole.rmax2, z1), s.rmax2 = at(whole.rmax1, whole.rmax2, z2);
}

/// The sides across x (or y) of a trd lean: a piece is a trap with the same fraction of both ends.
void cut_trd(Slice& piece, const Division& d, int i) {
  DivisibleShape& s = piece.shape;
  const bool x = d.axis == DivisionAxis::x;
  double& low = x ? s.x1 : s.y1;
  double& high = x ? s.x2 : s.y2;
  const double sum = low + high, middle = d.offset + (i + 0.5) * d.width;
  piece.translation[x ? 0 : 1] = middle - sum / 2;
  if (low == high) {
    low = high = d.width / 2;
    return;
  }
  const double shrink = 2 * low / sum, grow = 2 * high / sum;
  s.theta = std::atan(((middle * grow - high) - (middle * shrink - low)) / (2 * s.hz));
  s.phi = x ? 0 : std::numbers::pi / 2;
  s.tag = "trap";
  low = d.width / 2 * shrink;
  high = d.width / 2 * grow;
}

void cut_para(Slice& piece, const Division& d, double middle) {
  DivisibleShape& s = piece.shape;
  double(&t)[3] = piece.translation;
  if (d.axis == DivisionAxis::x) {
    s.x1 = d.width / 2;
    t[0] = middle;
  } else if (d.axis == DivisionAxis::y) {
    s.y1 = d.width / 2;
    t[0] = middle * std::tan(s.alpha);
    t[1] = middle;
  } else {
    s.hz = d.width / 2;
    t[0] = middle * std::tan(s.theta) * std::cos(s.phi);
    t[1] = middle * std::tan(s.theta) * std::sin(s.phi);
    t[2] = middle;
  }
}

/// Divides every plane of a polycone evenly, and the far end of a cone likewise.
void cut_outwards(DivisibleShape& s, const Division& d, int i) {
  const auto part = [&](double& rmin, double& rmax, double width) {
    const double from = rmin;
    rmin = from + d.offset + i * width;
    rmax = from + d.offset + (i + 1) * width;
  };
  const auto even = [&](double rmin, double rmax) { return (rmax - rmin - d.offset) / d.number; };
  for (ZPlane& plane : s.planes) part(plane.rmin, plane.rmax, even(plane.rmin, plane.rmax));
  if (has_planes(s)) return;
  part(s.rmin1, s.rmax1, d.width);
  if (s.tag == "cone") part(s.rmin2, s.rmax2, even(s.rmin2, s.rmax2));
}

}  // namespace

Solid make_shape(const std::string& name, const DivisibleShape& s) {
  if (s.tag == "box") return make_box(name, s.x1, s.y1, s.hz);
  if (s.tag == "tube") return make_tube(name, s.rmin1, s.rmax1, s.hz, s.start, s.delta);
  if (s.tag == "cone") {
    return make_cone(name, s.rmin1, s.rmax1, s.rmin2, s.rmax2, s.hz, s.start, s.delta);
  }
  if (s.tag == "trd") return make_trd(name, s.x1, s.x2, s.y1, s.y2, s.hz);
  if (s.tag == "para") return make_para(name, s.x1, s.y1, s.hz, s.alpha, s.theta, s.phi);
  if (s.tag == "polycone") return make_polycone(name, s.planes, s.start, s.delta);
  if (s.tag == "polyhedra") return make_polyhedra(name, s.planes, s.sides, s.start, s.delta);
  return make_trap(name, s.hz, s.theta, s.phi, s.y1, s.x1, s.x1, 0, s.y2, s.x2, s.x2, 0);
}

std::optional<double> divisible_length(const DivisibleShape& s, DivisionAxis axis) {
  const bool round = s.tag == "tube" || s.tag == "cone", planes = has_planes(s);
  const bool straight = s.tag == "box" || s.tag == "para" || s.tag == "trd";
  switch (axis) {
    case DivisionAxis::x:
      if (straight) return s.tag == "trd" ? s.x1 + s.x2 : 2 * s.x1;
      break;
    case DivisionAxis::y:
      if (straight) return s.tag == "trd" ? s.y1 + s.y2 : 2 * s.y1;
      break;
    case DivisionAxis::z:
      if (planes) return std::abs(s.planes.back().z - s.planes.front().z);
      if (straight || round) return 2 * s.hz;
      break;
    case DivisionAxis::rho:
      if (planes) return s.planes.front().rmax - s.planes.front().rmin;
      if (round) return s.rmax1 - s.rmin1;
      break;
    case DivisionAxis::phi:
      if (round || planes) return std::min(s.delta, 2 * std::numbers::pi);
      break;
  }
  return std::nullopt;
}

Slice slice(const DivisibleShape& shape, const Division& d, int i) {
  Slice piece{shape};
  DivisibleShape& s = piece.shape;
  const double from = d.offset + i * d.width;
  const auto index = static_cast<std::size_t>(i);
  if (d.axis == DivisionAxis::phi) {
    piece.turn = from;
    s.delta = d.width;
    if (s.sides > 0) s.sides = 1;
  } else if (d.axis == DivisionAxis::rho) {
    cut_outwards(s, d, i);
  } else if (d.by_planes) {
    const std::vector<ZPlane> planes = rising(s.planes, s.tag);
    const double middle = (planes[index].z + planes[index + 1].z) / 2;
    piece.translation[2] = middle;
    s.planes = {planes[index], planes[index + 1]};
    for (ZPlane& plane : s.planes) plane.z -= middle;
  } else if (s.tag == "para") {
    cut_para(piece, d, from + d.width / 2 - *divisible_length(s, d.axis) / 2);
  } else if (d.axis == DivisionAxis::z) {
    const double start = has_planes(s) ? std::min(s.planes.front().z, s.planes.back().z) : -s.hz;
    cut_along_z(s, start + from, start + from + d.width);
    piece.translation[2] = start + from + d.width / 2;
  } else if (s.tag == "trd") {
    cut_trd(piece, d, i);
  } else {
    (d.axis == DivisionAxis::x ? s.x1 : s.y1) = d.width / 2;
    const int axis = d.axis == DivisionAxis::x ? 0 : 1;
    piece.translation[axis] =
        -*divisible_length(shape, d.axis) / 2 + d.offset + (i + 0.5) * d.width;
  }
  return piece;
}

}  // namespace navjit::gdml
