#include "geometry/solids/sections.hpp"

#include <algorithm>

namespace navjit::detail {
namespace {

/// A part of the contour along which z changes, with z1 < z2.
struct Edge {
  double z1, r1, z2, r2;

  double radius_at(double z) const {
    if (z == z1) return r1;
    if (z == z2) return r2;
    return r1 + (r2 - r1) * ((z - z1) / (z2 - z1));
  }
};

/// A ring's radii at the two ends of its slab.
struct Ring {
  double rmin_low, rmax_low, rmin_high, rmax_high;
};

std::vector<Edge> contour_edges(std::span<const ZPlane> planes) {
  std::vector<Edge> edges;
  for (std::size_t i = 0; i + 1 < planes.size(); ++i) {
    const ZPlane &a = planes[i], &b = planes[i + 1];
    if (a.z == b.z) continue;
    const auto add = [&](double ra, double rb) {
      edges.push_back(a.z < b.z ? Edge{a.z, ra, b.z, rb} : Edge{b.z, rb, a.z, ra});
    };
    add(a.rmin, b.rmin);
    add(a.rmax, b.rmax);
  }
  return edges;
}

/// The rings between two neighbouring heights: along r, inside and outside alternate.
std::vector<Ring> rings_between(const std::vector<Edge>& edges, double low, double high,
                                const std::string& name) {
  struct Crossing {
    double at_low, at_high;
  };
  std::vector<Crossing> crossings;
  for (const Edge& edge : edges) {
    if (edge.z1 <= low && edge.z2 >= high) {
      crossings.push_back({edge.radius_at(low), edge.radius_at(high)});
    }
  }
  std::stable_sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
    return a.at_low + a.at_high < b.at_low + b.at_high;
  });
  std::vector<Ring> rings;
  for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
    const Crossing &a = crossings[i], &b = crossings[i + 1];
    require(a.at_low <= b.at_low && a.at_high <= b.at_high, name, "the contour crosses itself");
    const bool empty = a.at_low == b.at_low && a.at_high == b.at_high;
    if (i % 2 == 0 && !empty) rings.push_back({a.at_low, b.at_low, a.at_high, b.at_high});
  }
  return rings;
}

/// Adds a ledge where, at one height, there is a ring on one side only.
void add_ledges(double z, const std::vector<Ring>& below, const std::vector<Ring>& above,
                std::vector<kernels::Ledge<double>>& ledges) {
  std::vector<double> radii;
  for (const Ring& ring : below) radii.insert(radii.end(), {ring.rmin_high, ring.rmax_high});
  for (const Ring& ring : above) radii.insert(radii.end(), {ring.rmin_low, ring.rmax_low});
  std::sort(radii.begin(), radii.end());
  for (std::size_t i = 0; i + 1 < radii.size(); ++i) {
    const double low = radii[i], high = radii[i + 1];
    if (low == high) continue;
    const bool in_below = std::any_of(below.begin(), below.end(), [&](const Ring& ring) {
      return ring.rmin_high <= low && ring.rmax_high >= high;
    });
    const bool in_above = std::any_of(above.begin(), above.end(), [&](const Ring& ring) {
      return ring.rmin_low <= low && ring.rmax_low >= high;
    });
    if (in_below != in_above) ledges.push_back({z, low, high});
  }
}

/// How a ring is bored, as kernels::Section has it: 2 if its wall is thick compared with the
/// tolerance of any world.
int bore_of(const Ring& ring, double rmax, double height) {
  if (!(ring.rmin_low > 0 || ring.rmin_high > 0)) return 0;
  const double wall = std::min(ring.rmax_low - ring.rmin_low, ring.rmax_high - ring.rmin_high);
  return wall > std::max(1e-3, 1e-6 * (rmax + height)) ? 2 : 1;
}

/// Cuts at every height what the edges enclose.
Sections cut(const std::vector<Edge>& edges, std::vector<double> heights, double rmax,
             const std::string& name) {
  Sections made{{}, {}, rmax};
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());

  std::vector<Ring> below;
  for (std::size_t i = 0; i + 1 < heights.size(); ++i) {
    const double low = heights[i], high = heights[i + 1];
    std::vector<Ring> above = rings_between(edges, low, high, name);
    add_ledges(low, below, above, made.ledges);
    for (const Ring& ring : above) {
      made.sections.push_back({low, high, conical_face(ring.rmax_low, ring.rmax_high, high - low),
                               conical_face(ring.rmin_low, ring.rmin_high, high - low),
                               bore_of(ring, rmax, high - low)});
    }
    below = std::move(above);
  }
  require(!made.sections.empty(), name, "its contour encloses nothing");
  add_ledges(heights.back(), below, {}, made.ledges);
  return made;
}

}  // namespace

Sections make_sections(std::span<const ZPlane> planes, const std::string& name) {
  require(planes.size() >= 2, name, "at least two z planes are needed");
  std::vector<double> heights;
  double rmax = 0;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const ZPlane& plane = planes[i];
    require_finite({plane.z, plane.rmin, plane.rmax}, name);
    require(plane.rmin >= 0 && plane.rmax >= plane.rmin, name, "a z plane needs 0 <= rmin <= rmax");
    if (i > 0 && planes[i - 1].z == plane.z) {
      require(plane.rmin <= planes[i - 1].rmax && planes[i - 1].rmin <= plane.rmax, name,
              "the parts on the two sides of a step do not touch");
    }
    heights.push_back(plane.z);
    rmax = std::max(rmax, plane.rmax);
  }
  return cut(contour_edges(planes), std::move(heights), rmax, name);
}

Sections make_sections(std::span<const ContourPoint> contour, const std::string& name) {
  require(contour.size() >= 3, name, "its contour has less than three points");
  std::vector<double> heights;
  std::vector<Edge> edges;
  double rmax = 0;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const ContourPoint &a = contour[i], &b = contour[(i + 1) % contour.size()];
    require_finite({a.r, a.z}, name);
    require(a.r >= 0, name, "a radius of its contour is negative");
    heights.push_back(a.z);
    rmax = std::max(rmax, a.r);
    if (a.z != b.z) {
      edges.push_back(a.z < b.z ? Edge{a.z, a.r, b.z, b.r} : Edge{b.z, b.r, a.z, a.r});
    }
  }
  return cut(edges, std::move(heights), rmax, name);
}

}  // namespace navjit::detail
