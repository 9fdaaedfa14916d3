// TGeoTessellated: facets of three or four vertices. Two members have been there since the first
// version: the vertices, and the numbers of the vertices of each facet.
#include "geometry/root/reading.hpp"
#include "geometry/solids/bodies.hpp"

namespace navjit::root {
namespace {

constexpr std::size_t corners_at_most = 4;

/// The vertices that facets use, each once, by its number among all vertices.
class Corners {
 public:
  Corners(const Object& shape, std::span<const double> coordinates)
      : shape_(shape), coordinates_(coordinates), places_(coordinates.size() / 3, unknown) {}

  int place_of(double vertex, std::size_t facet) {
    if (!(vertex >= 0 && vertex < static_cast<double>(places_.size()))) {
      shape_.fail("a vertex of facet " + std::to_string(facet) + " is not among its " +
                  std::to_string(places_.size()));
    }
    const auto i = static_cast<std::size_t>(vertex);
    if (places_[i] == unknown) {
      places_[i] = static_cast<int>(used.size());
      const double* p = &coordinates_[3 * i];
      used.push_back({cm * p[0], cm * p[1], cm * p[2]});
    }
    return places_[i];
  }

  std::vector<Vec3> used{};

 private:
  static constexpr int unknown = -1;
  const Object& shape_;
  std::span<const double> coordinates_;
  std::vector<int> places_;
};

}  // namespace

Solid read_tessellated(Reading& reading, const Object& s) {
  const std::span<const double> coordinates = s.numbers("fVertices.fVec", 0),
                                counts = s.numbers("fFacets.fNvert", 0);
  const std::span<const double> vertices =
      s.numbers("fFacets.fIvert", corners_at_most * counts.size());
  if (counts.empty()) s.fail("it has no facets; close the shape before it is written");
  reading.facets += counts.size() + coordinates.size() / 3;
  if (reading.facets > reading.limits.max_facets) {
    s.fail("the tessellated solids have more than " + std::to_string(reading.limits.max_facets) +
           " facets and vertices in all; raise RootLimits::max_facets if this is meant");
  }
  Corners corners(s, coordinates);
  std::vector<kernels::Facet> triangles;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] != 3 && counts[i] != 4) {
      s.fail("facet " + std::to_string(i) + " has not three or four vertices");
    }
    const auto corner = [&](std::size_t k) {
      return corners.place_of(vertices[corners_at_most * i + k], i);
    };
    const int a = corner(0), b = corner(1), c = corner(2);
    triangles.push_back({a, b, c});
    if (counts[i] == 4) triangles.push_back({a, c, corner(3)});
  }
  std::string odd;
  Solid solid = detail::make_facets(s.name, std::move(corners.used), std::move(triangles), &odd);
  if (!odd.empty()) reading.notes.count("facets did not close on one another: closed them");
  return solid;
}

}  // namespace navjit::root
