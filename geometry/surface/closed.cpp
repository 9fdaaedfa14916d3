// Whether a surface encloses something: each edge is run along as often one way as the other.
#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <unordered_map>

#include "geometry/solids/bodies.hpp"
#include "navjit/surface.hpp"

namespace navjit {
namespace {

/// How many triangles run along an edge, forwards from its lower corner and back.
struct Uses {
  std::uint32_t forwards = 0, back = 0;
};

struct Edge {
  std::uint32_t from, to;
};

std::array<Edge, 3> edges_of(const Surface::Triangle& t) {
  return {{{t[0], t[1]}, {t[1], t[2]}, {t[2], t[0]}}};
}

std::uint64_t key(const Edge& e) {
  return std::uint64_t{std::min(e.from, e.to)} << 32 | std::max(e.from, e.to);
}

std::string text_of(const Vec3& p) {
  char text[96];
  std::snprintf(text, sizeof text, "(%.9g, %.9g, %.9g)", p.x, p.y, p.z);
  return text;
}

/// The triangles that have an edge.
std::vector<std::size_t> users_of(const Surface& surface, const Edge& edge) {
  std::vector<std::size_t> users;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    for (const Edge& e : edges_of(surface.triangles[i])) {
      if (key(e) == key(edge)) users.push_back(i);
    }
  }
  return users;
}

std::string name_of(const Surface& surface, std::size_t triangle) {
  if (triangle >= surface.origins.size()) return "triangle " + std::to_string(triangle);
  return (surface.origins_are_lines ? "the facet of line " : "facet ") +
         std::to_string(surface.origins[triangle]);
}

/// What is wrong along an edge of a triangle.
std::string describe(const Surface& surface, std::size_t triangle, const Edge& edge) {
  const std::string along = "the edge from " + text_of(surface.corners[edge.from]) + " to " +
                            text_of(surface.corners[edge.to]) + " mm";
  const std::vector<std::size_t> users = users_of(surface, edge);
  const std::string first = name_of(surface, triangle);
  if (users.size() == 1) {
    return "it is open: beyond " + along + " of " + first + " there is no other";
  }
  if (users.size() == 2) {
    const std::size_t other = users[0] == triangle ? users[1] : users[0];
    return first + " and " + name_of(surface, other) + " run the same way along " + along +
           ": one of them faces the wrong way, or is there twice";
  }
  return along + " of " + first + " is of " + std::to_string(users.size()) +
         " triangles, which do not run along it as often one way as the other";
}

}  // namespace

namespace {

/// Throws GeometryError of a solid of this name.
void require_corners(const Surface& surface, const std::string& name) {
  for (const Surface::Triangle& t : surface.triangles) {
    for (const std::uint32_t corner : t) {
      detail::require(corner < surface.corners.size(), name,
                      "a triangle has a corner that is none");
    }
  }
}

}  // namespace

std::string open_at(const Surface& surface) {
  require_corners(surface, "surface");
  std::unordered_map<std::uint64_t, Uses> edges;
  edges.reserve(surface.triangles.size() * 3 / 2);
  for (const Surface::Triangle& t : surface.triangles) {
    for (const Edge& e : edges_of(t))
      ++(e.from < e.to ? edges[key(e)].forwards : edges[key(e)].back);
  }
  const auto bad =
      static_cast<std::size_t>(std::count_if(edges.begin(), edges.end(), [](const auto& e) {
        return e.second.forwards != e.second.back;
      }));
  if (bad == 0) return {};
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    for (const Edge& e : edges_of(surface.triangles[i])) {
      const Uses& uses = edges[key(e)];
      if (uses.forwards == uses.back) continue;
      return describe(surface, i, e) +
             (bad > 1 ? " (the first of " + std::to_string(bad) + " such edges)" : "");
    }
  }
  return {};
}

Solid make_tessellated(std::string name, const Surface& surface) {
  require_corners(surface, name);
  const std::string open = open_at(surface);
  detail::require(open.empty(), name, open.c_str());
  std::vector<kernels::Facet> facets;
  facets.reserve(surface.triangles.size());
  for (const auto& [a, b, c] : surface.triangles) {
    facets.push_back({static_cast<int>(a), static_cast<int>(b), static_cast<int>(c)});
  }
  std::string note;
  Solid solid = detail::make_facets(name, surface.corners, std::move(facets), &note);
  // Corners that are nearer to one another than the solid can tell.
  detail::require(note.empty(), name, note.c_str());
  return solid;
}

}  // namespace navjit
