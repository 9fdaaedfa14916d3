// Shells of a surface that face the wrong way for their place, or that make no difference.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "geometry/bvh/box_tree.hpp"
#include "geometry/bvh/box_tree_traversal.hpp"
#include "geometry/solids/bodies.hpp"
#include "geometry/solids/facets.hpp"
#include "geometry/surface/shells.hpp"

namespace navjit {
namespace {

using Triangle = Surface::Triangle;

struct Shell {
  std::vector<std::uint32_t> triangles{};
  Solid body{};       ///< what it encloses, whichever way it faces; none if that is nothing
  double volume = 0;  ///< mm3; negative if it faces inwards
  std::vector<std::uint32_t> around{};  ///< shells that it lies within
  bool idle = false;                    ///< it encloses only what is so or so enclosed

  bool encloses() const { return body.shape != nullptr; }
};

Shell shell_of(const Surface& surface, std::vector<std::uint32_t> triangles) {
  std::vector<Vec3> corners;
  std::vector<kernels::Facet> facets;
  std::unordered_map<std::uint32_t, int> number;
  for (const std::uint32_t t : triangles) {
    std::array<int, 3> local{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t corner = surface.triangles[t][k];
      const auto [found, added] = number.try_emplace(corner, static_cast<int>(corners.size()));
      if (added) corners.push_back(surface.corners[corner]);
      local[k] = found->second;
    }
    facets.push_back({local[0], local[1], local[2]});
  }
  Shell shell{.triangles = std::move(triangles)};
  kernels::Facets<double> plain{};
  plain.corners = corners.data();
  plain.facets = facets.data();
  plain.facet_count = static_cast<int>(facets.size());
  shell.volume = SolidFacts<kernels::Facets<double>>::volume(plain);
  try {
    shell.body = detail::make_facets("shell", std::move(corners), std::move(facets), nullptr);
  } catch (const GeometryError&) {
    // It is flat or tiny. Wherever it lies, it changes nothing.
  }
  return shell;
}

/// How many corners of one shell are where, as another shell sees them.
struct Seen {
  std::uint32_t inside = 0, surface = 0;
};

/// Two shells, by their numbers.
using Pair = std::array<std::size_t, 2>;

kernels::Side side_of(const Shell& shell, const Vec3& p) {
  const Extent& e = shell.body.extent;
  const double size = std::max({e.max.x - e.min.x, e.max.y - e.min.y, e.max.z - e.min.z});
  const auto& body = *static_cast<const kernels::Facets<double>*>(shell.body.shape.get());
  return kernels::inside(body, p, 1e-9 * size);
}

/// Finds out which shells lie within which, by up to 64 corners of each. Returns those that cross.
std::vector<Pair> nest(const Surface& surface, std::vector<Shell>& shells) {
  // A box with min > max is that of a shell which encloses nothing.
  std::vector<Extent> boxes;
  for (const Shell& s : shells) {
    boxes.push_back(s.encloses() ? s.body.extent : Extent{{1, 1, 1}, {0, 0, 0}});
  }
  const bvh::BoxTree tree(boxes, 0, bvh::default_method(boxes.size()));
  std::vector<Pair> crossing;
  for (std::size_t i = 0; i < shells.size(); ++i) {
    if (!shells[i].encloses()) continue;
    const std::vector<std::uint32_t>& triangles = shells[i].triangles;
    const std::size_t stride = (triangles.size() + 63) / 64;
    std::map<std::size_t, Seen> others;
    std::uint32_t asked = 0;
    for (std::size_t t = 0; t < triangles.size(); t += stride, ++asked) {
      const Vec3& p = surface.corners[surface.triangles[triangles[t]][0]];
      tree.containing(p, [&](std::uint32_t j) {
        if (j == i || !shells[j].encloses()) return true;
        const kernels::Side side = side_of(shells[j], p);
        if (side == kernels::Side::inside) ++others[j].inside;
        if (side == kernels::Side::surface) ++others[j].surface;
        return true;
      });
    }
    for (const auto& [j, seen] : others) {
      if (seen.inside == 0) continue;
      if (seen.inside + seen.surface == asked) {
        shells[i].around.push_back(j);
      } else {
        crossing.push_back({i, j});
      }
    }
  }
  return crossing;
}

std::string name_of(const Surface& surface, const Shell& shell) {
  const std::uint32_t first = shell.triangles.front();
  std::string name = "the one of " + std::to_string(shell.triangles.size()) + " triangles";
  if (first >= surface.origins.size()) return name;
  return name + " with " + (surface.origins_are_lines ? "the facet of line " : "facet ") +
         std::to_string(surface.origins[first]);
}

/// What was done to some shells, of which one is named.
class Note {
 public:
  void add(const Surface& surface, const Shell& shell) {
    if (count_++ == 0) first_ = name_of(surface, shell);
  }
  void write(const std::string& what, std::vector<std::string>& notes) const {
    if (count_ == 0) return;
    notes.push_back(std::to_string(count_) + (count_ == 1 ? " shell " : " shells ") + what +
                    (count_ == 1 ? ": " : "; the first is ") + first_);
  }

 private:
  std::size_t count_ = 0;
  std::string first_;
};

/// Leaves out triangles that another one repeats, if what is left is closed. Returns how many.
std::size_t drop_doubled(Surface& surface) {
  Surface single = surface;
  single.triangles.clear();
  single.origins.clear();
  std::set<Triangle> known;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    Triangle t = surface.triangles[i];
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    if (!known.insert(t).second) continue;
    single.triangles.push_back(surface.triangles[i]);
    if (!surface.origins.empty()) single.origins.push_back(surface.origins[i]);
  }
  const std::size_t doubled = surface.triangles.size() - single.triangles.size();
  if (doubled == 0 || !open_at(single).empty()) return 0;
  surface = std::move(single);
  return doubled;
}

/// Turns shells, and leaves out those that are idle.
void keep_what_counts(Surface& surface, const std::vector<Shell>& shells,
                      const std::vector<bool>& turned) {
  std::vector<bool> left_out(surface.triangles.size());
  for (std::size_t i = 0; i < shells.size(); ++i) {
    for (const std::uint32_t t : shells[i].triangles) {
      left_out[t] = shells[i].idle;
      if (turned[i]) std::swap(surface.triangles[t][1], surface.triangles[t][2]);
    }
  }
  std::size_t kept = 0;
  for (std::size_t t = 0; t < left_out.size(); ++t) {
    if (left_out[t]) continue;
    surface.triangles[kept] = surface.triangles[t];
    if (!surface.origins.empty()) surface.origins[kept] = surface.origins[t];
    ++kept;
  }
  surface.triangles.resize(kept);
  if (!surface.origins.empty()) surface.origins.resize(kept);
}

}  // namespace

std::vector<std::string> mend_shells(Surface& surface) {
  if (const std::string open = open_at(surface); !open.empty()) {
    throw GeometryError("surface: " + open);
  }
  if (surface.origins.size() != surface.triangles.size()) surface.origins.clear();
  std::vector<std::string> notes;
  if (const std::size_t doubled = drop_doubled(surface); doubled > 0) {
    notes.push_back(std::to_string(doubled) +
                    " triangles are there twice: the second ones are left out");
  }
  std::vector<Shell> shells;
  for (std::vector<std::uint32_t>& triangles : surface::split(surface.triangles)) {
    shells.push_back(shell_of(surface, std::move(triangles)));
  }
  const std::vector<Pair> crossing = nest(surface, shells);

  // From the largest to the smallest, so that what is around a shell comes before it.
  std::vector<std::size_t> order(shells.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(shells[a].volume) > std::abs(shells[b].volume);
  });
  Note inside_out, idle;
  std::vector<bool> turned(shells.size());
  const auto step = [&](std::size_t k) { return (shells[k].volume > 0) != turned[k] ? 1 : -1; };
  for (const std::size_t i : order) {
    Shell& shell = shells[i];
    if (!shell.encloses()) continue;
    if (shell.around.empty()) {
      turned[i] = shell.volume < 0;
      if (turned[i]) inside_out.add(surface, shell);
      continue;
    }
    // What lies within a shell that is inside out was written inside out with it.
    turned[i] = turned[*std::max_element(
        shell.around.begin(), shell.around.end(), [&](std::size_t a, std::size_t b) {
          return std::abs(shells[a].volume) < std::abs(shells[b].volume);
        })];
    // A point is in the body if more shells around it face outwards than inwards.
    int depth = 0;
    for (const std::size_t k : shell.around) depth += step(k);
    shell.idle = (depth > 0) == (depth + step(i) > 0);
    if (shell.idle) idle.add(surface, shell);
  }
  inside_out.write("facing inwards, but within no other one: turned", notes);
  idle.write("within others that makes no difference to the body: left out", notes);
  if (!crossing.empty()) {
    notes.push_back(std::to_string(crossing.size()) +
                    " times a shell crosses another one, so that the volume between them counts "
                    "twice; the first are " +
                    name_of(surface, shells[crossing[0][0]]) + " and " +
                    name_of(surface, shells[crossing[0][1]]));
  }
  keep_what_counts(surface, shells, turned);
  return notes;
}

}  // namespace navjit
