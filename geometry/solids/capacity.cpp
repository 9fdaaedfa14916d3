// Volumes in closed form, from the kernels' shapes.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/solids/facets.hpp"
#include "geometry/solids/solid.hpp"

namespace navjit {
namespace {

using std::numbers::pi;

/// The angle that a wedge leaves, rad.
double angle_of(const kernels::Wedge<double>& w) {
  if (w.kind == 0) return 2 * pi;
  const double angle = std::atan2(w.start_x * w.end_y - w.start_y * w.end_x,
                                  w.start_x * w.end_x + w.start_y * w.end_y);
  return angle > 0 ? angle : angle + 2 * pi;
}

/// Integral of the squared radius over z in [from, to].
double squared_radius_integral(const kernels::ConicalFace<double>& f, double from, double to) {
  const double r1 = (f.radius + f.slope * from) / f.cosine;
  const double r2 = (f.radius + f.slope * to) / f.cosine;
  return (to - from) * (r1 * r1 + r1 * r2 + r2 * r2) / 3;
}

double volume(const kernels::Box<double>& s) { return 8 * s.hx * s.hy * s.hz; }

double volume(const kernels::Tube<double>& s) {
  return angle_of(s.wedge) * (s.rmax - s.rmin) * (s.rmax + s.rmin) * s.hz;
}

double volume(const kernels::Cone<double>& s) {
  double integral = squared_radius_integral(s.outer, -s.hz, s.hz);
  if (s.bored != 0) integral -= squared_radius_integral(s.inner, -s.hz, s.hz);
  return angle_of(s.wedge) / 2 * integral;
}

double volume(const kernels::Trd<double>& s) {
  // Half lengths in x and y are linear in z.
  const auto half = [](const kernels::FacePair<double>& f, double z) {
    return (f.offset - f.along * z) / f.across;
  };
  const double x = half(s.x, 0), y = half(s.y, 0);
  const double dx = half(s.x, s.hz) - x, dy = half(s.y, s.hz) - y;
  return 8 * s.hz * (x * y + dx * dy / 3);
}

/// Area of the trapezoid at height z: the sides across y are parallel to x in every section.
double area_at(const kernels::Trap<double>& s, double z) {
  const auto y_on = [&](const kernels::Plane<double>& f) { return -(f.c * z + f.d) / f.b; };
  const auto x_on = [&](const kernels::Plane<double>& f, double y) {
    return -(f.b * y + f.c * z + f.d) / f.a;
  };
  const double y1 = y_on(s.y_minus), y2 = y_on(s.y_plus), y = (y1 + y2) / 2;
  return (y2 - y1) * (x_on(s.x_plus, y) - x_on(s.x_minus, y));
}
double volume(const kernels::Trap<double>& s) {
  // The area is quadratic in z.
  return s.hz / 3 * (area_at(s, -s.hz) + 4 * area_at(s, 0) + area_at(s, s.hz));
}

double volume(const kernels::Hull<double>& s) { return detail::hull_volume(s); }
double volume(const kernels::Facets<double>& s) { return detail::facets_volume(s); }
double volume(const kernels::Prism<double>& s) { return detail::prism_volume(s); }

double volume(const kernels::CutTube<double>& s) {
  // The integral of the height over the sector: linear in x and y.
  const auto& w = s.wedge;
  const auto at = [](const kernels::Plane<double>& f) { return -f.d / f.c; };
  const double tilt_x = s.low.a / s.low.c - s.high.a / s.high.c;
  const double tilt_y = s.low.b / s.low.c - s.high.b / s.high.c;
  const double squares = (s.rmax - s.rmin) * (s.rmax + s.rmin) / 2;
  const double cubes = (s.rmax * s.rmax * s.rmax - s.rmin * s.rmin * s.rmin) / 3;
  double volume = angle_of(w) * squares * (at(s.high) - at(s.low));
  if (w.kind != 0) {
    volume += cubes * (tilt_x * (w.end_y - w.start_y) + tilt_y * (w.start_x - w.end_x));
  }
  return volume;
}

/// The integral over z of the area within, from the straight lines that the corners run along.
double volume(const kernels::Arb8<double>& s) {
  const kernels::TwistedFace<double>* faces[] = {&s.first, &s.second, &s.third, &s.fourth};
  // Corners where two neighbouring sides meet; the area is quadratic in z.
  const auto area_at = [&](double z) {
    double x[4], y[4];
    int corners = 0;
    for (int i = 0; i < 4; ++i) {
      const auto &f = *faces[i], &g = *faces[(i + 1) % 4];
      const double fa = f.a * z + f.e, fb = f.b * z + f.f, fc = (f.c * z + f.d) * z + f.g;
      const double ga = g.a * z + g.e, gb = g.b * z + g.f, gc = (g.c * z + g.d) * z + g.g;
      const double det = fa * gb - fb * ga;
      if (std::abs(det) < 1e-12 * std::hypot(fa, fb) * std::hypot(ga, gb)) continue;
      x[corners] = (fb * gc - fc * gb) / det;
      y[corners++] = (fc * ga - fa * gc) / det;
    }
    double twice = 0;
    for (int i = 2; i < corners; ++i) {
      twice += (x[i - 1] - x[0]) * (y[i] - y[0]) - (y[i - 1] - y[0]) * (x[i] - x[0]);
    }
    return std::abs(twice) / 2;
  };
  // Gauss's three points, so that no section is looked at where a side has no length.
  const double far = s.hz * std::sqrt(0.6);
  return s.hz / 9 * (5 * area_at(-far) + 8 * area_at(0) + 5 * area_at(far));
}

double volume(const kernels::Orb<double>& s) { return 4 * pi / 3 * s.radius * s.radius * s.radius; }

double volume(const kernels::Sphere<double>& s) {
  const auto cosine = [](const kernels::PolarLimit<double>& limit, double none) {
    if (limit.kind == 0) return none;
    return limit.face.slope < 0 ? -limit.face.cosine : limit.face.cosine;
  };
  const double heights = cosine(s.low, 1) - cosine(s.high, -1);
  const double shell = (s.rmax - s.rmin) * (s.rmax * s.rmax + s.rmax * s.rmin + s.rmin * s.rmin);
  return angle_of(s.wedge) / 3 * heights * shell;
}

template <class Sections>
double sections_volume(const Sections& s, double area_factor) {
  double integral = 0;
  for (int i = 0; i < s.count; ++i) {
    const auto& section = s.sections[i];
    const double length = section.z_high - section.z_low;
    integral += squared_radius_integral(section.outer, 0, length);
    if (section.bored != 0) integral -= squared_radius_integral(section.inner, 0, length);
  }
  return area_factor * integral;
}
double volume(const kernels::Polycone<double>& s) {
  return sections_volume(s, angle_of(s.wedge) / 2);
}
double volume(const kernels::Polyhedra<double>& s) {
  return sections_volume(s, s.side_count * std::tan(angle_of(s.wedge) / (2 * s.side_count)));
}

/// Integral of the distance from the axis over a disc around radius `ring`, without what would be
/// beyond the axis.
double disc_moment(double ring, double r) {
  if (r <= ring) return ring * (pi * r * r);
  const double cut = std::sqrt((r - ring) * (r + ring));
  return ring * (r * r * (pi / 2 + std::asin(ring / r)) + ring * cut) + cut * cut * cut * 2 / 3;
}
double volume(const kernels::Torus<double>& s) {
  if (s.rmax <= s.rtor) {
    return angle_of(s.wedge) * s.rtor * (pi * (s.rmax - s.rmin) * (s.rmax + s.rmin));
  }
  return angle_of(s.wedge) * (disc_moment(s.rtor, s.rmax) - disc_moment(s.rtor, s.rmin));
}

/// Volume within a quadric between two planes; its sections are ellipses.
double quadric_volume(const kernels::Quadric<double>& f, double low, double high) {
  if (f.c > 0) {
    const double reach = std::sqrt(-f.e / f.c);
    low = std::max(low, -reach);
    high = std::min(high, reach);
  }
  const auto primitive = [&](double z) { return z * (f.e + z * (f.d / 2 + z * (f.c / 3))); };
  return pi / std::sqrt(f.a * f.b) * (primitive(low - f.origin) - primitive(high - f.origin));
}
double volume(const kernels::TwistedTube<double>& s) {
  // Every section is a sector of the same angle.
  const double angle = angle_of({1, s.start.ny, -s.start.nx, -s.end.ny, s.end.nx});
  return angle / (2 * pi) *
         (quadric_volume(s.outer, s.z_low, s.z_high) - quadric_volume(s.inner, s.z_low, s.z_high));
}

double volume(const kernels::TwistedTrap<double>& s) {
  // Sections are trapezoids with the sides across w parallel; twist and shear keep their area.
  const auto area = [&](double z) {
    const double height = s.back.c0 + s.back.c1 * z + s.front.c0 + s.front.c1 * z;
    const auto middle = [&](const kernels::TwistedSide<double>& f) {
      return (f.c0 + (f.c1 + f.c2 * z) * z) / (f.nu + f.nu1 * z);
    };
    return height * (middle(s.right) - middle(s.left));
  };
  return s.hz / 3 * (area(-s.hz) + 4 * area(0) + area(s.hz));
}

double volume(const kernels::QuadricSolid<double>& s) {
  const double outer = quadric_volume(s.outer, s.z_low, s.z_high);
  return s.bored == 0 ? outer : outer - quadric_volume(s.inner, s.z_low, s.z_high);
}

double volume(const kernels::AnySolid<double>& s);

double volume(const kernels::AnyPlaced<double>& s) { return volume(s.solid); }
double volume(const kernels::AnyScaled<double>& s) {
  return volume(s.solid) / std::abs(s.inverse_x * s.inverse_y * s.inverse_z);
}
template <class Boolean>
double volume(const Boolean&) {
  return std::numeric_limits<double>::quiet_NaN();
}

double volume(const kernels::AnySolid<double>& s) {
  return kernels::visit(s, [](const auto& shape) { return volume(shape); });
}

}  // namespace

double capacity(const Solid& solid) { return volume(solid.any()); }

}  // namespace navjit
