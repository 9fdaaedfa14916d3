// The searches among a scene's daughters: which one holds a point, which one a ray meets first.
#include <cmath>
#include <string>
#include <vector>

#include "analysis/axis.hpp"
#include "codegen/scene_text.hpp"
#include "codegen/tables.hpp"
#include "codegen/text.hpp"
#include "geometry/bvh/rounding.hpp"

namespace navjit::codegen {
namespace {

/// The fields that CellGrid and BlockGrid share.
std::string grid_fields(const Grid& b) {
  std::string text = "{";
  for (int a = 0; a < 3; ++a) text += (a == 0 ? "" : ", ") + std::to_string(b.count[a]);
  text += "}, {";
  for (int a = 0; a < 3; ++a) text += (a == 0 ? "" : ", ") + number(b.origin[a]);
  text += "}, {";
  for (int a = 0; a < 3; ++a) text += (a == 0 ? "" : ", ") + number(b.width[a]);
  text += "}, {";
  for (int a = 0; a < 3; ++a) text += (a == 0 ? "" : ", ") + number(1 / b.width[a]);
  return text + "}";
}

/// find() and nearest() by two functions that visit candidates at a point and along a ray.
std::string searches(const std::string& visit_at, const std::string& walk) {
  return std::string(find_head) + "  int found = -1;\n  " + visit_at +
         "(grid, p, [&](unsigned k) {\n"
         "    if (static_cast<int>(k) == blocked || !holds(k, p, d)) return true;\n"
         "    found = static_cast<int>(k);\n"
         "    return false;\n  });\n  return found;\n}\n" +
         nearest_head + "  " + walk +
         "(grid, p, d, [&](unsigned k) {\n"
         "    const double t = distance(k, p, d, smaller(limit, best));\n"
         "    if (t < best || (t == best && hit >= 0 && static_cast<int>(k) < hit)) {\n"
         "      best = t;\n      hit = static_cast<int>(k);\n    }\n"
         "  }, [&] { return smaller(limit, best); });\n  return hit;\n}\n";
}

}  // namespace

/// The body of a function of a daughter's number k: `call` for its solid.
std::string SceneText::daughter_switch(const char* call) const {
  const bool one = plan_.classes.size() == 1;
  std::string text = "  const Daughter& at = daughters[k];\n";
  if (!one) text += "  switch (at.kind) {\n";
  for (std::size_t c = 0; c < plan_.classes.size(); ++c) {
    if (!one) {
      text +=
          c + 1 == plan_.classes.size() ? "    default: " : "    case " + std::to_string(c) + ": ";
    } else {
      text += "    ";
    }
    text += daughter_case(plan_.classes[c], call, "at.x", "at.y", "at.z", "at.rotation");
  }
  return text + (one ? "}\n" : "  }\n}\n");
}

/// Whether a daughter holds a point, and how far along a ray it is.
std::string SceneText::daughter_tests() const {
  return "[[gnu::always_inline]] static inline bool holds(unsigned k, const Vec3<double>& p, const "
         "Direction<double>& d) {\n" +
         daughter_switch("contains") +
         "[[gnu::always_inline]] static inline double distance(unsigned k, const Vec3<double>& p, "
         "const Direction<double>& d, [[maybe_unused]] double reach) {\n" +
         daughter_switch("distance_to_in");
}

/// Spelled-out daughters unroll: the index is a constant at each call.
std::string SceneText::search_all() const {
  std::string text = find_head;
  for (std::size_t k = scene_.daughters.size(); k-- > 0;) {
    const std::string i = std::to_string(k);
    text += "  if (blocked != " + i + " && holds(" + i + ", p, d)) return " + i + ";\n";
  }
  text += std::string("  return -1;\n}\n") + nearest_head;
  for (std::size_t k = 0; k < scene_.daughters.size(); ++k) {
    const std::string i = std::to_string(k);
    text += "  if (const double t = distance(" + i +
            ", p, d, smaller(limit, best)); t < best) {\n    best = t;\n    hit = " + i +
            ";\n  }\n";
  }
  return text + "  return hit;\n}\n";
}

/// Boxes alone: see the kernel "four_boxes". Along faces the rules are out of line.
std::string SceneText::search_lanes() const {
  const auto daughters = scene_.daughters;
  std::string text = "constexpr FourBoxes fours[] = {\n";
  for (std::size_t first = 0; first < daughters.size(); first += lanes_of_four) {
    text += "  {";
    for (int field = 0; field < 6; ++field) {
      text += field == 0 ? "{" : ", {";
      for (std::size_t k = first; k < first + lanes_of_four; ++k) {
        text += k == first ? "" : ", ";
        if (k >= daughters.size()) {
          text += field < 3 ? "0" : "-__builtin_inf()";
          continue;
        }
        const auto& box = *static_cast<const kernels::Box<double>*>(daughters[k].solid.shape);
        const double half[3] = {box.hx, box.hy, box.hz};
        text +=
            number(field < 3 ? daughters[k].transformation.translation[field] : half[field - 3]);
      }
      text += "}";
    }
    text += "},\n";
  }
  return text +
         "};\n"
         "[[gnu::noinline, gnu::cold]] static int find_along(double x, double y, double z, double "
         "u, double v, double w, int blocked) {\n"
         "  for (int k = " +
         std::to_string(daughters.size()) +
         "; k-- > 0;) {\n"
         "    if (k != blocked && holds(static_cast<unsigned>(k), {x, y, z}, "
         "make_heading<double>(u, v, w))) return k;\n"
         "  }\n  return -1;\n}\n" +
         find_head +
         "  if (__builtin_expect(!is_oblique(d), 0)) return find_along(p.x, p.y, p.z, d.x, d.y, "
         "d.z, blocked);\n"
         "  return last_box_at(fours, p, d, tolerance, blocked);\n}\n" +
         nearest_head +
         "  nearest_of_boxes(fours, p, d, tolerance, best, hit);\n  return hit;\n}\n";
}

std::string SceneText::search_slabs() const {
  const Slabs& s = plan_.slabs;
  const char* index = index_type(scene_.daughters.size());
  std::vector<std::uint32_t> position(s.members.size());
  for (std::uint32_t i = 0; i < s.members.size(); ++i) position[s.members[i]] = i;
  std::string text = list(index, "by_position", s.members) + list(index, "position", position) +
                     list("double", "low", s.low) + list("double", "high", s.high) +
                     list(index, "ascending", s.ascending) +
                     list(index, "descending", s.descending);
  text += std::string("constexpr SlabRow<") + index + "> slabs{" +
          std::to_string(s.members.size()) + ", low, high, by_position, position, " +
          number(s.skin) + ", " + number(s.origin) + ", " + number(1 / s.width) + ", " +
          std::to_string(s.ascending.size()) + ", ascending, descending};\n";
  const std::string axis(1, "xyz"[s.axis]);
  text += find_head;
  text +=
      "  int found = -1;\n"
      "  visit_slabs_at(slabs, p." +
      axis +
      ", [&](unsigned k) {\n"
      "    const int i = static_cast<int>(k);\n"
      "    if (i > found && i != blocked && holds(k, p, d)) found = i;\n"
      "  });\n  return found;\n}\n";
  const std::string along = "p." + axis + ", d." + axis + ", d.inverse_" + axis;
  const std::string visit =
      "[&](unsigned k) {\n"
      "    const double t = distance(k, p, d, smaller(limit, best));\n"
      "    if (t < best || (t == best && hit >= 0 && static_cast<int>(k) < hit)) {\n"
      "      best = t;\n      hit = static_cast<int>(k);\n      return true;\n    }\n"
      "    return false;\n  });\n";
  if (!plan_.oblique_only) {
    return text + nearest_head + "  walk_slabs(slabs, " + along + ", smaller(limit, best), left, " +
           visit + "  return hit;\n}\n";
  }
  // Mostly the first slab is the one; the loop over others would keep registers from it.
  return text +
         "struct Found {\n  double best;\n  int hit;\n};\n"
         "[[gnu::noinline, gnu::cold]] static Found nearest_from(int i, double x, double y, double "
         "z, double u, double v, double w, double iu, double iv, double iw, double best, double "
         "limit) {\n"
         "  const Vec3<double> p{x, y, z};\n  const Direction<double> d{u, v, w, iu, iv, iw};\n"
         "  int hit = -1;\n  walk_slabs_from(slabs, i, " +
         along + ", smaller(limit, best), " + visit + "  return {best, hit};\n}\n" + nearest_head +
         "  const int i = first_slab<true>(slabs, p." + axis + ", d." + axis +
         ", left);\n"
         "  if (i == end_of_slabs(slabs, d." +
         axis + ") || slab_is_beyond(slabs, i, " + along +
         ", smaller(limit, best))) return hit;\n"
         "  const unsigned k = slabs.daughter[i];\n"
         "  const double t = distance(k, p, d, smaller(limit, best));\n"
         "  if (__builtin_expect(t < best, 1)) {\n    best = t;\n    return static_cast<int>(k);\n"
         "  }\n"
         "  const Found found = nearest_from(d." +
         axis +
         " < 0 ? i - 1 : i + 1, p.x, p.y, p.z, d.x, d.y, d.z, d.inverse_x, d.inverse_y, "
         "d.inverse_z, best, limit);\n"
         "  best = found.best;\n  return found.hit;\n}\n";
}

std::string SceneText::search_grid() const {
  const Grid& b = plan_.grid;
  const char* index = index_type(scene_.daughters.size());
  return list("unsigned", "first", b.first) + list(index, "members", b.members) +
         "constexpr CellGrid<" + index + "> grid{" + grid_fields(b) + ", first, members};\n" +
         searches("visit_cell_at", "walk_cells");
}

std::string box_block(const std::function<const Extent*(std::size_t)>& box) {
  std::string text = "{";
  for (const bool upper : {false, true}) {
    text += upper ? "}, {" : "{";
    for (int axis = 0; axis < 3; ++axis) {
      text += axis == 0 ? "{" : ", {";
      for (std::size_t lane = 0; lane < box_lanes; ++lane) {
        const Extent* e = box(lane);
        text += (lane == 0 ? "" : ", ") + float_number(e == nullptr ? (upper ? -INFINITY : INFINITY)
                                                       : upper ? bvh::float_above(high(*e, axis))
                                                               : bvh::float_below(low(*e, axis)));
      }
      text += "}";
    }
  }
  return text + "}},\n";
}

std::string SceneText::search_boxes() const {
  const Grid& b = plan_.grid;
  const char* index = index_type(scene_.daughters.size());
  std::string blocks = "constexpr BoxBlock blocks[] = {\n", daughters;
  std::vector<std::uint32_t> first{0};
  for (std::size_t cell = 0; cell < b.size(); ++cell) {
    std::uint32_t count = first.back();
    for (std::uint32_t m = b.first[cell]; m < b.first[cell + 1]; m += box_lanes, ++count) {
      const std::size_t used = std::min<std::size_t>(box_lanes, b.first[cell + 1] - m);
      blocks += box_block([&](std::size_t lane) {
        return lane < used ? &plan_.boxes[b.members[m + lane]] : nullptr;
      });
      daughters += daughters.empty() ? "{" : ",\n  {";
      for (std::size_t i = 0; i < box_lanes; ++i) {
        daughters += (i == 0 ? "" : ", ") + std::to_string(i < used ? b.members[m + i] : 0);
      }
      daughters += "}";
    }
    first.push_back(count);
  }
  return list("unsigned", "first", first) + blocks + "};\nconstexpr " + index +
         " in_block[][box_lanes] = {" + daughters + "};\nconstexpr BlockGrid<" + index + "> grid{" +
         grid_fields(b) + ", first, blocks, in_block};\n" +
         searches("visit_blocks_at", "walk_blocks");
}

/// The neighbour list of each daughter, and the search on leaving it.
std::string SceneText::search_neighbours() const {
  const NeighbourLists& s = scene_.neighbour_lists;
  std::string text = "constexpr NeighbourList lists[] = {\n";
  bool all_listed = true;
  for (const NeighbourLists::Of& of : s.of) {
    const Extent& b = of.box;
    const unsigned count = of.listed() ? of.count : ~0U;
    all_listed &= of.listed();
    text += "  {{" + number(b.min.x) + ", " + number(b.min.y) + ", " + number(b.min.z) + "}, {" +
            number(b.max.x) + ", " + number(b.max.y) + ", " + number(b.max.z) + "}, " +
            std::to_string(of.first) + ", " + std::to_string(count) + "U, " +
            (of.mother_contains ? "true" : "false") + "},\n";
  }
  text += "};\n";
  if (!s.neighbours.empty()) {
    text += list(index_type(scene_.daughters.size()), "neighbours", s.neighbours);
  }
  // Out of line, and by numbers: what is seldom needed shall keep nothing in memory.
  text +=
      "[[gnu::noinline, gnu::cold]] static int find_elsewhere(double x, double y, double z, double "
      "u, double v, double w, int blocked) {\n"
      "  return find({x, y, z}, make_heading<double>(u, v, w), blocked);\n}\n"
      "[[gnu::always_inline]] static inline int find_neighbour([[maybe_unused]] const "
      "NeighbourList& "
      "a, bool "
      "there, const "
      "Vec3<double>& p, const Direction<double>& d, int blocked) {\n  if (__builtin_expect(!there";
  if (!all_listed) text += " || a.count == ~0U";
  text += ", 0)) return find_elsewhere(p.x, p.y, p.z, d.x, d.y, d.z, blocked);\n";
  if (!s.neighbours.empty()) {
    text +=
        "  for (unsigned m = a.first; m != a.first + a.count; ++m) {\n"
        "    if (holds(neighbours[m], p, d)) return static_cast<int>(neighbours[m]);\n  }\n";
  }
  return text + "  return -1;\n}\n";
}

std::string SceneText::search() const {
  shapes_.constant(scene_.solid);
  std::string text = "namespace " + ns_ + " {\n" + frame();
  if (scene_.daughters.empty()) return text + "}  // namespace " + ns_ + "\n";
  text += tables() + daughter_tests();
  switch (plan_.candidates) {
    case Candidates::none:
    case Candidates::wires:
    case Candidates::tree:
      break;
    case Candidates::lanes:
      text += search_lanes();
      break;
    case Candidates::all:
      text += search_all();
      break;
    case Candidates::slabs:
      text += search_slabs();
      break;
    case Candidates::nest:
      text += search_nest();
      break;
    case Candidates::rings:
      text += search_rings();
      break;
    case Candidates::grid:
      text += search_grid();
      break;
    case Candidates::boxes:
      text += search_boxes();
  }
  if (plan_.neighbour_lists) text += search_neighbours();
  return text + push() + descend() + "}  // namespace " + ns_ + "\n";
}

}  // namespace navjit::codegen
