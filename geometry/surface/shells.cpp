#include "geometry/surface/shells.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <span>
#include <unordered_map>

namespace navjit::surface {
namespace {

using Triangle = Surface::Triangle;

/// One use of an edge by a triangle.
struct EdgeUse {
  std::uint64_t edge;  ///< its two corners, the lower one first
  std::uint32_t triangle;
  int turn;  ///< +1 from the lower corner to the higher one, -1 the other way
};

/// The uses of all edges; those of one edge are neighbours.
std::vector<EdgeUse> edge_uses(const std::vector<Triangle>& triangles) {
  std::vector<EdgeUse> uses;
  uses.reserve(triangles.size() * 3);
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = triangles[i][k], b = triangles[i][(k + 1) % 3];
      uses.push_back({std::uint64_t{std::min(a, b)} << 32 | std::max(a, b), i, a < b ? 1 : -1});
    }
  }
  std::sort(uses.begin(), uses.end(),
            [](const EdgeUse& a, const EdgeUse& b) { return a.edge < b.edge; });
  return uses;
}

/// Calls visit(uses) for the uses of each edge.
template <class Visit>
void for_each_edge(std::span<const EdgeUse> uses, const Visit& visit) {
  for (std::size_t first = 0; first < uses.size();) {
    std::size_t last = first;
    while (last < uses.size() && uses[last].edge == uses[first].edge) ++last;
    visit(uses.subspan(first, last - first));
    first = last;
  }
}

/// Sets of triangles that are united step by step.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }
  std::uint32_t of(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::uint32_t a, std::uint32_t b) { parent_[of(a)] = of(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

/// A normal of any length.
Vec3 normal_of(const Surface& surface, std::uint32_t triangle) {
  const Triangle& t = surface.triangles[triangle];
  const Vec3& a = surface.corners[t[0]];
  return cross(surface.corners[t[1]] - a, surface.corners[t[2]] - a);
}

/// Whether the normals are those of one plane, but for the rounding of corners to single precision.
bool face_alike(const Vec3& n, const Vec3& m) {
  constexpr double largest_sine = 1e-5;
  return dot(n, m) > 0 && norm(cross(n, m)) <= largest_sine * norm(n) * norm(m);
}

}  // namespace

std::vector<std::vector<std::uint32_t>> split(const std::vector<Triangle>& triangles) {
  const std::vector<EdgeUse> uses = edge_uses(triangles);
  Sets sets(triangles.size());
  for_each_edge(uses, [&](std::span<const EdgeUse> of_edge) {
    if (of_edge.size() == 2) sets.unite(of_edge[0].triangle, of_edge[1].triangle);
  });
  std::map<std::uint32_t, int> turns;
  for_each_edge(uses, [&](std::span<const EdgeUse> of_edge) {
    if (of_edge.size() == 2) return;
    turns.clear();
    for (const EdgeUse& use : of_edge) turns[sets.of(use.triangle)] += use.turn;
    const bool closed =
        std::all_of(turns.begin(), turns.end(), [](const auto& t) { return t.second == 0; });
    for (const EdgeUse& use : of_edge) {
      if (!closed) sets.unite(use.triangle, of_edge[0].triangle);
    }
  });
  std::vector<std::vector<std::uint32_t>> shells;
  std::unordered_map<std::uint32_t, std::size_t> number;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const auto [found, added] = number.try_emplace(sets.of(i), shells.size());
    if (added) shells.emplace_back();
    shells[found->second].push_back(i);
  }
  return shells;
}

std::vector<std::uint32_t> upon_others(const Surface& surface) {
  // Of triangles that run the same way along an edge and face alike, each is on the same side of
  // it. No more than so many of one edge are compared with each: it stays quick, whatever a file
  // holds.
  constexpr std::size_t most_compared = 16;
  const std::vector<EdgeUse> uses = edge_uses(surface.triangles);
  std::vector<std::uint32_t> found;
  for_each_edge(uses, [&](std::span<const EdgeUse> of_edge) {
    if (of_edge.size() == 2) return;
    for (std::size_t i = 0; i < of_edge.size(); ++i) {
      const std::size_t end = std::min(of_edge.size(), i + 1 + most_compared);
      const Vec3 normal = normal_of(surface, of_edge[i].triangle);
      for (std::size_t k = i + 1; k < end; ++k) {
        if (of_edge[k].turn != of_edge[i].turn ||
            !face_alike(normal, normal_of(surface, of_edge[k].triangle))) {
          continue;
        }
        found.insert(found.end(), {of_edge[i].triangle, of_edge[k].triangle});
      }
    }
  });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace navjit::surface
