// Writes solids of flat faces, and of faces that are ruled by straight lines.
#include <cmath>

#include "geometry/gdml/write/solids.hpp"
#include "navjit/errors.hpp"
#include "navjit/vector.hpp"

namespace navjit::gdml {
namespace {

using Plane = kernels::Plane<double>;

[[noreturn]] void fail(const std::string& name, const char* why) {
  throw GeometryError("solid '" + name + "' cannot be written as GDML: " + why);
}

/// A line in a plane across z: a x + b y + c = 0. The solid is on the negative side.
struct Line {
  double a, b, c;
};

Line line_at(const Plane& f, double z) { return {f.a, f.b, f.c * z + f.d}; }

PlanarPoint meet(const std::string& name, const Line& f, const Line& g) {
  const double area = f.a * g.b - f.b * g.a;
  const PlanarPoint p{(f.b * g.c - g.b * f.c) / area, (g.a * f.c - f.a * g.c) / area};
  if (!std::isfinite(p.x) || !std::isfinite(p.y)) fail(name, "two of its sides do not meet");
  return p;
}

std::string section_text(double z, double x, double y, double scale, int order) {
  return "<section" + attribute("zOrder", std::to_string(order)) +
         attributes({{"zPosition", z}, {"xOffset", x}, {"yOffset", y}, {"scalingFactor", scale}}) +
         "/>";
}

std::string polygon_text(const std::vector<PlanarPoint>& polygon) {
  std::string text;
  for (const PlanarPoint& p : polygon) {
    text += "<twoDimVertex" + attributes({{"x", p.x}, {"y", p.y}}) + "/>";
  }
  return text;
}

/// A hull that was made of two sections has the planes of the ends first, then its sides in order.
bool write_as_extruded(SolidWriter& out, const std::string& name, const kernels::Hull<double>& s) {
  const auto across_z = [&](int i, double up) {
    return s.planes[i].a == 0 && s.planes[i].b == 0 && s.planes[i].c == up;
  };
  if (s.count < 5 || !across_z(0, -1) || !across_z(1, 1)) return false;
  const double low = s.planes[0].d, high = -s.planes[1].d;
  const int sides = s.count - 2;
  std::vector<PlanarPoint> below, above;
  for (int i = 0; i < sides; ++i) {
    const Plane &f = s.planes[2 + (i + sides - 1) % sides], &g = s.planes[2 + i];
    if (!(std::abs(f.a * g.b - f.b * g.a) > 1e-9)) return false;
    below.push_back(meet(name, line_at(f, low), line_at(g, low)));
    above.push_back(meet(name, line_at(f, high), line_at(g, high)));
  }
  // The larger end is the polygon, and the other end a scaled copy of it.
  const auto size = [](const std::vector<PlanarPoint>& p) {
    double largest = 0;
    for (const PlanarPoint& q : p) {
      largest = std::max(largest, std::hypot(q.x - p[0].x, q.y - p[0].y));
    }
    return largest;
  };
  const double size_below = size(below), size_above = size(above);
  const bool upwards = size_above > size_below;
  const auto &large = upwards ? above : below, &small = upwards ? below : above;
  const double most = std::max(size_below, size_above);
  double scale = std::min(size_below, size_above) / most;
  if (!(scale > 1e-6)) return false;
  if (std::abs(scale - 1) < 1e-12) scale = 1;
  const double x = small[0].x - scale * large[0].x, y = small[0].y - scale * large[0].y;
  for (std::size_t i = 0; i < large.size(); ++i) {
    const double off =
        std::hypot(scale * large[i].x + x - small[i].x, scale * large[i].y + y - small[i].y);
    if (!(off <= 1e-11 * (most + std::abs(x) + std::abs(y)))) return false;
  }
  out.write("xtru", name, in_mm(),
            polygon_text(large) +
                (upwards ? section_text(low, x, y, scale, 0) + section_text(high, 0, 0, 1, 1)
                         : section_text(low, 0, 0, 1, 0) + section_text(high, x, y, scale, 1)));
  return true;
}

/// The part of a polygon that lies behind a plane.
std::vector<Vec3> behind(const std::vector<Vec3>& polygon, const Plane& f) {
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double at_p = kernels::plane_distance(f, p), at_q = kernels::plane_distance(f, q);
    if (at_p <= 0) kept.push_back(p);
    if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0)) {
      kept.push_back(p + (at_p / (at_p - at_q)) * (q - p));
    }
  }
  return kept;
}

/// A face of a hull: a square around the point nearest to the origin, cut by all other planes.
std::vector<Vec3> face_of(const kernels::Hull<double>& s, int face, double reach) {
  const Plane& f = s.planes[face];
  const Vec3 normal{f.a, f.b, f.c}, foot = (-f.d) * normal;
  const double x = std::abs(f.a), y = std::abs(f.b), z = std::abs(f.c);
  const Vec3 axis = x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  Vec3 u{f.b * axis.z - f.c * axis.y, f.c * axis.x - f.a * axis.z, f.a * axis.y - f.b * axis.x};
  u = (reach / norm(u)) * u;
  const Vec3 w{f.b * u.z - f.c * u.y, f.c * u.x - f.a * u.z, f.a * u.y - f.b * u.x};
  std::vector<Vec3> polygon{foot + u + w, foot - u + w, foot - u - w, foot + u - w};
  for (int k = 0; k < s.count && !polygon.empty(); ++k) {
    if (k != face) polygon = behind(polygon, s.planes[k]);
  }
  return polygon;
}

/// The corner of another face at this point, or else the point. Each face computes its corners from
/// its own plane, so that those which several faces share differ by roundings.
Vec3 shared_corner(std::vector<Vec3>& known, const Vec3& p, double roundings) {
  for (const Vec3& corner : known) {
    if (norm(corner - p) <= roundings) return corner;
  }
  known.push_back(p);
  return p;
}

std::string facet_text(const std::string& a, const std::string& b, const std::string& c) {
  return "<triangular" + attribute("vertex1", a) + attribute("vertex2", b) +
         attribute("vertex3", c) + attribute("type", "ABSOLUTE") + "/>";
}

}  // namespace

void write_shape(SolidWriter& out, const std::string& name, const kernels::Box<double>& s) {
  out.write("box", name, attributes({{"x", 2 * s.hx}, {"y", 2 * s.hy}, {"z", 2 * s.hz}}) + in_mm());
}

void write_shape(SolidWriter& out, const std::string& name, const kernels::Trd<double>& s) {
  const auto whole = [](const kernels::FacePair<double>& f, double z) {
    return std::max(0.0, 2 * ((f.offset - f.along * z) / f.across));
  };
  out.write("trd", name,
            attributes({{"x1", whole(s.x, -s.hz)},
                        {"x2", whole(s.x, s.hz)},
                        {"y1", whole(s.y, -s.hz)},
                        {"y2", whole(s.y, s.hz)},
                        {"z", 2 * s.hz}}) +
                in_mm());
}

void write_shape(SolidWriter& out, const std::string& name, const kernels::Trap<double>& s) {
  struct End {
    double hy, half_low, half_high, slant, x, y;
  };
  const auto end_at = [&](double z) {
    const auto corner = [&](const Plane& f, const Plane& g) {
      return meet(name, line_at(f, z), line_at(g, z));
    };
    const PlanarPoint a = corner(s.x_minus, s.y_minus), b = corner(s.x_plus, s.y_minus);
    const PlanarPoint c = corner(s.x_minus, s.y_plus), d = corner(s.x_plus, s.y_plus);
    const double low = (a.y + b.y) / 2, high = (c.y + d.y) / 2;
    const double middle_low = (a.x + b.x) / 2, middle_high = (c.x + d.x) / 2;
    return End{(high - low) / 2,
               (b.x - a.x) / 2,
               (d.x - c.x) / 2,
               std::atan2(middle_high - middle_low, high - low),
               (middle_low + middle_high) / 2,
               (low + high) / 2};
  };
  const End e = end_at(-s.hz), f = end_at(s.hz);
  const double x = f.x - e.x, y = f.y - e.y;
  out.write("trap", name,
            attributes({{"z", 2 * s.hz},
                        {"theta", std::atan2(std::hypot(x, y), 2 * s.hz)},
                        {"phi", std::atan2(y, x)},
                        {"y1", 2 * e.hy},
                        {"x1", 2 * e.half_low},
                        {"x2", 2 * e.half_high},
                        {"alpha1", e.slant},
                        {"y2", 2 * f.hy},
                        {"x3", 2 * f.half_low},
                        {"x4", 2 * f.half_high},
                        {"alpha2", f.slant}}) +
                in_rad() + in_mm());
}

void write_shape(SolidWriter& out, const std::string& name, const kernels::Arb8<double>& s) {
  using Face = kernels::TwistedFace<double>;
  std::vector<const Face*> sides{&s.first, &s.second, &s.third, &s.fourth};
  const auto same = [](const Face& f, const Face& g) {
    return f.a == g.a && f.b == g.b && f.c == g.c && f.d == g.d && f.e == g.e && f.f == g.f &&
           f.g == g.g;
  };
  if (same(s.third, s.fourth)) sides.pop_back();
  const std::size_t count = sides.size();
  std::string text;
  for (const double z : {-s.hz, s.hz}) {
    const auto line = [&](std::size_t i) {
      const Face& f = *sides[i % count];
      return Line{f.a * z + f.e, f.b * z + f.f, (f.c * z + f.d) * z + f.g};
    };
    for (std::size_t i = 0; i < 4; ++i) {
      // A triangle repeats its last corner.
      const std::size_t k = std::min(i, count - 1);
      const PlanarPoint p = meet(name, line(k + count - 1), line(k));
      const std::string which = "v" + std::to_string((z < 0 ? 1 : 5) + i);
      text += attributes({{which + "x", p.x}, {which + "y", p.y}});
    }
  }
  out.write("arb8", name, text + attributes({{"dz", s.hz}}) + in_mm());
}

void write_shape(SolidWriter& out, const std::string& name, const kernels::Hull<double>& s) {
  if (write_as_extruded(out, name, s)) return;
  // Faces are cut from squares. First ones that are large enough are looked for, in which the reach
  // is found: of a solid that leans, planes near the origin have corners that are far away. Then
  // they are cut from squares near to the reach, for accurate corners.
  const auto furthest_corner = [&](double square) {
    double furthest = 0;
    for (int i = 0; i < s.count; ++i) {
      for (const Vec3& p : face_of(s, i, square)) furthest = std::max(furthest, norm(p));
    }
    if (!(furthest > 0)) fail(name, "its planes enclose nothing");
    return furthest;
  };
  double square = 0;
  for (int i = 0; i < s.count; ++i) square = std::max(square, std::abs(s.planes[i].d));
  double reach = 0;
  do {
    square *= 1e3;
    reach = furthest_corner(square);
  } while (reach > square / 2 && square < 1e30);
  reach = 2 * furthest_corner(2 * reach);
  std::string facets;
  std::vector<Vec3> known;
  for (int i = 0; i < s.count; ++i) {
    std::vector<std::string> corners;
    for (const Vec3& p : face_of(s, i, reach)) {
      const std::string corner = out.define(name + "_v", shared_corner(known, p, 1e-11 * reach));
      if (corners.empty() || (corner != corners.back() && corner != corners.front())) {
        corners.push_back(corner);
      }
    }
    for (std::size_t k = 2; k < corners.size(); ++k) {
      facets += facet_text(corners[0], corners[k - 1], corners[k]);
    }
  }
  out.write("tessellated", name, in_mm() + in_rad(), facets);
}

void write_shape(SolidWriter& out, const std::string& name, const kernels::Facets<double>& s) {
  std::vector<std::string> corners;
  for (int i = 0; i < s.corner_count; ++i) corners.push_back(out.define(name + "_v", s.corners[i]));
  const auto corner = [&](int i) { return corners[static_cast<std::size_t>(i)]; };
  std::string facets;
  for (int i = 0; i < s.facet_count; ++i) {
    facets += facet_text(corner(s.facets[i].a), corner(s.facets[i].b), corner(s.facets[i].c));
  }
  out.write("tessellated", name, in_mm() + in_rad(), facets);
}

void write_shape(SolidWriter& out, const std::string& name, const kernels::Prism<double>& s) {
  std::vector<PlanarPoint> polygon;
  for (int i = 0; i < s.count; ++i) polygon.push_back({s.corners[i].x, s.corners[i].y});
  out.write("xtru", name, in_mm(),
            polygon_text(polygon) + section_text(s.z_low, 0, 0, 1, 0) +
                section_text(s.z_high, 0, 0, 1, 1));
}

void write_twisted(SolidWriter& out, const std::string& name, SolidKind kind,
                   const kernels::TwistedTrap<double>& s) {
  // The inverse of make_twisted(): the dimensions that this holds are linear in z.
  const double y0 = s.front.c0, y1 = s.front.c1, hz = s.hz;
  double x0 = 0, x1 = 0, slant = 0, d0 = 0, d1 = 0;
  if (s.steepening == 0) {
    const double right = -s.right.nw / s.right.nu, left = -s.left.nw / s.left.nu;
    x0 = s.right.c0 / s.right.nu;
    x1 = s.right.c1 / s.right.nu;
    slant = (right + left) / 2;
    const double lean = (right - left) / 2;
    d0 = lean * y0;
    d1 = lean * y1;
  } else {
    const double n = y0 / s.right.nu, right = s.right.nw * n, left = s.left.nw * (-y0 / s.left.nu);
    x0 = s.right.c0 * n / y0;
    x1 = (s.right.c1 * n - y1 * x0) / y0;
    slant = (left - right) / (2 * y0);
    d0 = -(right + left) / 2;
    d1 = -(s.right.nw1 * n + slant * y1);
  }
  const auto end = [&](double z) {
    struct Sizes {
      double y, x_low, x_high;
    };
    const double x = x0 + x1 * z, d = d0 + d1 * z;
    return Sizes{2 * (y0 + y1 * z), 2 * (x - d), 2 * (x + d)};
  };
  const auto low = end(-hz), high = end(hz);
  const double twist = 2 * hz * s.rate;
  if (kind == SolidKind::twistedbox) {
    out.write("twistedbox", name,
              attributes({{"PhiTwist", twist}, {"x", 2 * x0}, {"y", 2 * y0}, {"z", 2 * hz}}) +
                  in_rad() + in_mm());
  } else if (kind == SolidKind::twistedtrd) {
    out.write("twistedtrd", name,
              attributes({{"PhiTwist", twist},
                          {"x1", low.x_low},
                          {"x2", high.x_low},
                          {"y1", low.y},
                          {"y2", high.y},
                          {"z", 2 * hz}}) +
                  in_rad() + in_mm());
  } else {
    out.write("twistedtrap", name,
              attributes({{"PhiTwist", twist},
                          {"z", 2 * hz},
                          {"Theta", std::atan(std::hypot(s.shear_x, s.shear_y))},
                          {"Phi", std::atan2(s.shear_y, s.shear_x)},
                          {"y1", low.y},
                          {"x1", low.x_low},
                          {"x2", low.x_high},
                          {"y2", high.y},
                          {"x3", high.x_low},
                          {"x4", high.x_high},
                          {"Alph", std::atan(slant)}}) +
                  in_rad() + in_mm());
  }
}

}  // namespace navjit::gdml
