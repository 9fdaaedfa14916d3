// ROOT's shapes that are given by numbers alone. Their lengths are in cm, angles in degrees.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "geometry/root/reading.hpp"

namespace navjit::root {
namespace {

constexpr double degree = std::numbers::pi / 180;

double length(const Object& shape, std::string_view member) { return cm * shape.number(member); }
double angle(const Object& shape, std::string_view member) { return degree * shape.number(member); }

/// An angle of which only the tangent matters, less half turns: files have 334 degrees for -26.
double slant(const Object& shape, std::string_view member) {
  return degree * std::remainder(shape.number(member), 180);
}

/// An azimuth from fPhi1 to the larger fPhi2.
struct Azimuth {
  double start, delta;
};
Azimuth azimuth(const Object& shape) {
  const double from = shape.number("fPhi1");
  double delta = shape.number("fPhi2") - from;
  if (delta <= 0) delta += 360;
  return {from * degree, std::min(delta, 360.0) * degree};
}

Solid read_box(const Object& s) {
  Solid box = make_box(s.name, length(s, "fDX"), length(s, "fDY"), length(s, "fDZ"));
  const std::span<const double> o = s.numbers("fOrigin", 3);
  if (o[0] == 0 && o[1] == 0 && o[2] == 0) return box;
  return make_placed(s.name, box, {{cm * o[0], cm * o[1], cm * o[2]}});
}

Solid read_tube(const Object& s) {
  return make_tube(s.name, length(s, "fRmin"), length(s, "fRmax"), length(s, "fDz"), 0,
                   2 * std::numbers::pi);
}

Solid read_tube_segment(const Object& s) {
  const Azimuth phi = azimuth(s);
  return make_tube(s.name, length(s, "fRmin"), length(s, "fRmax"), length(s, "fDz"), phi.start,
                   phi.delta);
}

Solid read_cut_tube(const Object& s) {
  const Azimuth phi = azimuth(s);
  const std::span<const double> low = s.numbers("fNlow", 3), high = s.numbers("fNhigh", 3);
  return make_cut_tube(s.name, length(s, "fRmin"), length(s, "fRmax"), length(s, "fDz"), phi.start,
                       phi.delta, {low[0], low[1], low[2]}, {high[0], high[1], high[2]});
}

Solid read_cone_of(const Object& s, const Azimuth& phi) {
  return make_cone(s.name, length(s, "fRmin1"), length(s, "fRmax1"), length(s, "fRmin2"),
                   length(s, "fRmax2"), length(s, "fDz"), phi.start, phi.delta);
}
Solid read_cone(const Object& s) { return read_cone_of(s, {0, 2 * std::numbers::pi}); }
Solid read_cone_segment(const Object& s) { return read_cone_of(s, azimuth(s)); }

constexpr std::size_t most_planes = 1000;  // as in GDML

std::vector<ZPlane> planes_of(const Object& s) {
  const std::size_t count = s.count("fNz", most_planes);
  const std::span<const double> z = s.numbers("fZ", count), rmin = s.numbers("fRmin", count),
                                rmax = s.numbers("fRmax", count);
  std::vector<ZPlane> planes;
  for (std::size_t i = 0; i < count; ++i) planes.push_back({cm * z[i], cm * rmin[i], cm * rmax[i]});
  return planes;
}

double delta_phi(const Object& s) { return std::min(s.number("fDphi"), 360.0) * degree; }

Solid read_polycone(const Object& s) {
  return make_polycone(s.name, planes_of(s), angle(s, "fPhi1"), delta_phi(s));
}
Solid read_polyhedra(const Object& s) {
  return make_polyhedra(s.name, planes_of(s), static_cast<int>(s.count("fNedges", most_planes)),
                        angle(s, "fPhi1"), delta_phi(s));
}

Solid read_trd1(const Object& s) {
  const double hy = length(s, "fDy");
  return make_trd(s.name, length(s, "fDx1"), length(s, "fDx2"), hy, hy, length(s, "fDz"));
}
Solid read_trd2(const Object& s) {
  return make_trd(s.name, length(s, "fDx1"), length(s, "fDx2"), length(s, "fDy1"),
                  length(s, "fDy2"), length(s, "fDz"));
}

Solid read_arb8(const Object& s) {
  const std::span<const double> xy = s.numbers("fXY", 16);
  std::array<PlanarPoint, 8> corners;
  for (std::size_t i = 0; i < 8; ++i) corners[i] = {cm * xy[2 * i], cm * xy[2 * i + 1]};
  return make_arb8(s.name, length(s, "fDz"), corners);
}

/// Edges may have no length; the corners say the same.
Solid read_trap(const Object& s) {
  constexpr std::string_view edges[] = {"fH1", "fBl1", "fTl1", "fH2", "fBl2", "fTl2"};
  const auto is_none = [&](std::string_view edge) { return s.number(edge) == 0; };
  if (std::ranges::any_of(edges, is_none)) return read_arb8(s);
  return make_trap(s.name, length(s, "fDz"), slant(s, "fTheta"), angle(s, "fPhi"), length(s, "fH1"),
                   length(s, "fBl1"), length(s, "fTl1"), slant(s, "fAlpha1"), length(s, "fH2"),
                   length(s, "fBl2"), length(s, "fTl2"), slant(s, "fAlpha2"));
}
/// The corners in the file are turned already.
Solid read_twisted_trap(const Object& s) {
  return s.number("fTwistAngle") == 0 ? read_trap(s) : read_arb8(s);
}

Solid read_para(const Object& s) {
  return make_para(s.name, length(s, "fX"), length(s, "fY"), length(s, "fZ"), slant(s, "fAlpha"),
                   slant(s, "fTheta"), angle(s, "fPhi"));
}

Solid read_sphere(const Object& s) {
  const Azimuth phi = azimuth(s);
  const double theta = s.number("fTheta1");
  return make_sphere(s.name, length(s, "fRmin"), length(s, "fRmax"), phi.start, phi.delta,
                     theta * degree, (s.number("fTheta2") - theta) * degree);
}

Solid read_torus(const Object& s) {
  return make_torus(s.name, length(s, "fRmin"), length(s, "fRmax"), length(s, "fR"),
                    angle(s, "fPhi1"), delta_phi(s));
}

/// The half axes are in the members that hold the radii of other tubes.
Solid read_elliptical_tube(const Object& s) {
  return make_eltube(s.name, length(s, "fRmin"), length(s, "fRmax"), length(s, "fDz"));
}

Solid read_hyperboloid(const Object& s) {
  return make_hype(s.name, length(s, "fRmin"), length(s, "fRmax"), angle(s, "fStIn"),
                   angle(s, "fStOut"), length(s, "fDz"));
}

Solid read_paraboloid(const Object& s) {
  const double low = length(s, "fRlo"), high = length(s, "fRhi"), hz = length(s, "fDz");
  if (low <= high) return make_paraboloid(s.name, low, high, hz);
  // GDML's paraboloids widen upwards.
  return make_scaled(s.name, make_paraboloid(s.name, high, low, hz), 1, 1, -1);
}

struct Reader {
  std::string_view type;
  Solid (*read)(const Object&);
};
constexpr Reader readers[] = {
    {"TGeoBBox", read_box},
    {"TGeoTube", read_tube},
    {"TGeoTubeSeg", read_tube_segment},
    {"TGeoCtub", read_cut_tube},
    {"TGeoCone", read_cone},
    {"TGeoConeSeg", read_cone_segment},
    {"TGeoPcon", read_polycone},
    {"TGeoPgon", read_polyhedra},
    {"TGeoTrd1", read_trd1},
    {"TGeoTrd2", read_trd2},
    {"TGeoTrap", read_trap},
    {"TGeoGtra", read_twisted_trap},
    {"TGeoPara", read_para},
    {"TGeoArb8", read_arb8},
    {"TGeoSphere", read_sphere},
    {"TGeoTorus", read_torus},
    {"TGeoEltu", read_elliptical_tube},
    {"TGeoHype", read_hyperboloid},
    {"TGeoParaboloid", read_paraboloid},
};

/// The reader of a class; null if there is none.
const Reader* reader_of(const Object& shape) {
  const auto* found =
      std::ranges::find_if(readers, [&](const Reader& r) { return shape.is(r.type); });
  return found == std::end(readers) ? nullptr : found;
}

}  // namespace

bool is_flat(const Object& shape) {
  // Each class of shapes has the box around it as its base.
  const auto is_none = [&](std::string_view half) { return shape.number(half, 1) == 0; };
  return reader_of(shape) != nullptr && (is_none("fDX") || is_none("fDY") || is_none("fDZ"));
}

Solid read_primitive(const Object& shape) {
  const Reader* const reader = reader_of(shape);
  if (reader == nullptr) {
    shape.fail("unsupported kind of shape; docs/root.md has those that are read");
  }
  return reader->read(shape);
}

}  // namespace navjit::root
