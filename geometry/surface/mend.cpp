// Shells of a surface that face the wrong way, and triangles that are there twice.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
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
  Extent box{};
  double volume = 0;      ///< mm3; negative if it faces inwards
  bool encloses = false;  ///< what encloses nothing changes nothing
};

/// A shell's own corners, and its triangles by their numbers.
struct Body {
  std::vector<Vec3> corners{};
  std::vector<kernels::Facet> facets{};
};
Body body_of(const Surface& surface, const std::vector<std::uint32_t>& triangles) {
  Body body;
  std::unordered_map<std::uint32_t, int> number;
  for (const std::uint32_t t : triangles) {
    std::array<int, 3> local{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t corner = surface.triangles[t][k];
      const auto [found, added] = number.try_emplace(corner, static_cast<int>(body.corners.size()));
      if (added) body.corners.push_back(surface.corners[corner]);
      local[k] = found->second;
    }
    body.facets.push_back({local[0], local[1], local[2]});
  }
  return body;
}

Shell shell_of(const Surface& surface, std::vector<std::uint32_t> triangles) {
  const Body body = body_of(surface, triangles);
  kernels::Facets<double> shape{};
  shape.corners = body.corners.data();
  shape.facets = body.facets.data();
  shape.facet_count = static_cast<int>(body.facets.size());
  Shell shell{.triangles = std::move(triangles)};
  shell.volume = SolidFacts<kernels::Facets<double>>::volume(shape);
  shell.box = {body.corners.front(), body.corners.front()};
  for (const Vec3& p : body.corners) {
    shell.box.min = {std::min(shell.box.min.x, p.x), std::min(shell.box.min.y, p.y),
                     std::min(shell.box.min.z, p.z)};
    shell.box.max = {std::max(shell.box.max.x, p.x), std::max(shell.box.max.y, p.y),
                     std::max(shell.box.max.z, p.z)};
  }
  // Less might be nothing once corners within 1e-9 of the size are merged.
  constexpr double least = 1e-8;
  shell.encloses = enclose_more(shape, shell.volume, norm(shell.box.max - shell.box.min), least);
  return shell;
}

/// The shells of each part: those whose boxes meet, directly or by way of others. Only these can
/// have to do with one another.
std::vector<std::vector<std::size_t>> parts_of(const std::vector<Shell>& shells) {
  // Boxes that merely touch do not meet.
  std::vector<Extent> inner;
  for (const Shell& shell : shells) {
    const Vec3 margin = 1e-4 * (shell.box.max - shell.box.min);
    inner.push_back({shell.box.min + margin, shell.box.max - margin});
  }
  const bvh::BoxTree boxes(inner, 0, bvh::default_method(inner.size()));
  // Where very many boxes meet, all shells are one part: nothing is turned that might be right.
  constexpr std::size_t most_meetings = 20'000'000;
  std::vector<std::size_t> part(shells.size(), shells.size());
  std::vector<std::vector<std::size_t>> parts;
  std::size_t meetings = 0;
  for (std::size_t first = 0; first < shells.size(); ++first) {
    if (part[first] != shells.size()) continue;
    const std::size_t own = parts.size();
    std::vector<std::size_t>& members = parts.emplace_back();
    members.push_back(first);
    part[first] = own;
    for (std::size_t next = 0; next < members.size(); ++next) {
      boxes.overlapping(inner[members[next]], [&](std::uint32_t k) {
        if (part[k] == shells.size()) {
          part[k] = own;
          members.push_back(k);
        }
        return ++meetings < most_meetings;
      });
    }
  }
  if (meetings < most_meetings) return parts;
  parts.assign(1, {});
  for (std::size_t k = 0; k < shells.size(); ++k) parts[0].push_back(k);
  return parts;
}

/// "the facet of line N", or an empty text if the surface comes from no file.
std::string name_of(const Surface& surface, std::uint32_t triangle) {
  if (triangle >= surface.origins.size()) return {};
  return (surface.origins_are_lines ? "the facet of line " : "facet ") +
         std::to_string(surface.origins[triangle]);
}
std::string name_of(const Surface& surface, const Shell& shell) {
  const std::string facet = name_of(surface, shell.triangles.front());
  return "the one of " + std::to_string(shell.triangles.size()) + " triangles" +
         (facet.empty() ? "" : " with " + facet);
}

/// Leaves out triangles that another one repeats, if what is left is closed.
void drop_doubled(Surface& surface, std::vector<std::string>& notes) {
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
  if (doubled == 0) return;
  const std::string what = std::to_string(doubled) + " triangles are there twice";
  if (open_at(single).empty()) {
    surface = std::move(single);
    notes.push_back(what + ": the second ones are left out");
  } else {
    notes.push_back(what +
                    ", and the surface is open without them, so that they stay: parts overlap "
                    "there, or a part that touches another one seems to face inwards");
  }
}

/// Turns the parts that are inside out: holes are smaller than what they are in, so that the shells
/// of a part enclose more than nothing together.
void turn(Surface& surface, std::vector<Shell>& shells,
          const std::vector<std::vector<std::size_t>>& parts, std::vector<std::string>& notes) {
  std::size_t turned = 0;
  std::string first;
  for (const std::vector<std::size_t>& part : parts) {
    double volume = 0;
    for (const std::size_t k : part) volume += shells[k].volume;
    if (!(volume < 0)) continue;
    for (const std::size_t k : part) {
      shells[k].volume = -shells[k].volume;
      for (const std::uint32_t t : shells[k].triangles) {
        std::swap(surface.triangles[t][1], surface.triangles[t][2]);
      }
    }
    if (turned == 0) first = name_of(surface, shells[part.front()]);
    turned += part.size();
  }
  if (turned == 0) return;
  notes.push_back(std::to_string(turned) +
                  (turned == 1 ? " shell was inside out and is turned: "
                               : " shells were inside out and are turned; the first is ") +
                  first);
}

/// Names the first of the triangles that lie upon others: parts that have edges in common are one
/// shell, so that shells do not tell that they overlap.
void look_for_triangles_upon_others(const Surface& surface, const std::vector<Shell>& shells,
                                    std::vector<std::string>& notes) {
  std::vector<std::uint32_t> upon = surface::upon_others(surface);
  if (upon.empty()) return;
  std::vector<const Shell*> shell_of(surface.triangles.size());
  for (const Shell& shell : shells) {
    for (const std::uint32_t t : shell.triangles) shell_of[t] = &shell;
  }
  std::erase_if(upon, [&](std::uint32_t t) { return shell_of[t] == nullptr; });
  if (upon.empty()) return;
  const std::string facet = name_of(surface, upon.front());
  notes.push_back(std::to_string(upon.size()) +
                  " triangles lie upon others that face as they do, so that parts overlap and the "
                  "volume is not exact: the first is " +
                  (facet.empty() ? "" : facet + ", ") + "in the shell of " +
                  std::to_string(shell_of[upon.front()]->triangles.size()) + " triangles");
}

/// The place just below a triangle.
Vec3 below(const Surface& surface, const Surface::Triangle& t, double depth) {
  const Vec3 &a = surface.corners[t[0]], &b = surface.corners[t[1]], &c = surface.corners[t[2]];
  const Vec3 n = cross(b - a, c - a);
  const double length = norm(n);
  const Vec3 centre = (1.0 / 3) * (a + b + c);
  return length > 0 ? centre - (depth / length) * n : centre;
}

/// Names shells that overlap others that face as they do, and holes that reach out of the body, by
/// up to 16 corners of each, or places below its triangles. Navigation takes everything for one
/// body, but volumes add up.
void look_for_overlaps(const Surface& surface, const std::vector<Shell>& shells,
                       const bvh::BoxTree& boxes, std::vector<std::string>& notes) {
  std::size_t questions = 100'000;  // enough for what people look at, and quick
  std::vector<Solid> bodies(shells.size());
  const auto side_of = [&](std::size_t k, const Vec3& p) {
    if (bodies[k].shape == nullptr) {
      Body body = body_of(surface, shells[k].triangles);
      bodies[k] =
          detail::make_facets("shell", std::move(body.corners), std::move(body.facets), nullptr);
    }
    const auto& shape = *static_cast<const kernels::Facets<double>*>(bodies[k].shape.get());
    return kernels::inside(shape, p, 1e-9 * norm(shells[k].box.max - shells[k].box.min));
  };
  /// Within how many of the other shells a place is; holes count against them. Nothing where it is
  /// on the surface of one, or if there were too many questions.
  const auto depth_in_others = [&](std::size_t i, const Vec3& p) {
    std::optional<int> depth = 0;
    boxes.containing(p, [&](std::uint32_t k) {
      if (k == i) return true;
      const kernels::Side side = questions > 0 ? side_of(k, p) : kernels::Side::surface;
      if (questions > 0) --questions;
      if (side == kernels::Side::inside) *depth += shells[k].volume > 0 ? 1 : -1;
      if (side == kernels::Side::surface) depth.reset();
      return depth.has_value();
    });
    return depth;
  };
  std::size_t overlapping = 0;
  std::string first;
  for (std::size_t i = 0; i < shells.size() && questions > 0; ++i) {
    const std::vector<std::uint32_t>& triangles = shells[i].triangles;
    const bool outwards = shells[i].volume > 0;
    const double size = norm(shells[i].box.max - shells[i].box.min);
    const std::size_t stride = (triangles.size() + 15) / 16;
    bool overlaps = false;
    for (std::size_t t = 0; t < triangles.size() && !overlaps; t += stride) {
      const Surface::Triangle& triangle = surface.triangles[triangles[t]];
      std::optional<int> depth = depth_in_others(i, surface.corners[triangle[0]]);
      // A corner on the surface of another shell does not tell on which side the body is.
      if (!depth && outwards) depth = depth_in_others(i, below(surface, triangle, 1e-7 * size));
      overlaps = depth && outwards == (*depth > 0);
    }
    if (!overlaps) continue;
    if (overlapping++ == 0) first = name_of(surface, shells[i]);
  }
  if (overlapping == 0) return;
  notes.push_back(std::to_string(overlapping) +
                  (overlapping == 1 ? " shell overlaps" : " shells overlap") +
                  " others, or is a hole that reaches out of them, and the volume is not exact: " +
                  (overlapping == 1 ? "" : "the first is ") + first);
}

}  // namespace

std::vector<std::string> mend_shells(Surface& surface) {
  if (const std::string open = open_at(surface); !open.empty()) {
    throw GeometryError("surface: " + open);
  }
  if (surface.origins.size() != surface.triangles.size()) surface.origins.clear();
  std::vector<std::string> notes;
  drop_doubled(surface, notes);
  std::vector<Shell> shells;
  for (std::vector<std::uint32_t>& triangles : surface::split(surface.triangles)) {
    Shell shell = shell_of(surface, std::move(triangles));
    if (shell.encloses) shells.push_back(std::move(shell));
  }
  if (shells.empty()) return notes;
  std::vector<Extent> extents;
  for (const Shell& shell : shells) extents.push_back(shell.box);
  const bvh::BoxTree boxes(extents, 0, bvh::default_method(extents.size()));
  turn(surface, shells, parts_of(shells), notes);
  look_for_triangles_upon_others(surface, shells, notes);
  if (shells.size() > 1) look_for_overlaps(surface, shells, boxes, notes);
  return notes;
}

}  // namespace navjit
