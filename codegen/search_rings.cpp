// The searches of scenes about an axis: nests of shells, and rings.
#include <algorithm>

#include "codegen/scene_text.hpp"
#include "codegen/tables.hpp"

namespace navjit::codegen {
namespace {

/// Up to so many daughters beside a pattern are asked one by one, more by their boxes.
constexpr std::size_t few_others = 2;

/// A visit of candidates at a point, and one of candidates along a ray.
const char* const visits_at =
    "  int found = -1;\n"
    "  const auto visit = [&](unsigned k) {\n"
    "    const int i = static_cast<int>(k);\n"
    "    if (i > found && i != blocked && holds(k, p, d)) found = i;\n  };\n";
const char* const visits_along =
    "  const auto reach = [&] { return smaller(limit, best); };\n"
    "  const auto visit = [&](unsigned k) {\n"
    "    const double t = distance(k, p, d, smaller(limit, best));\n"
    "    if (t < best || (t == best && hit >= 0 && static_cast<int>(k) < hit)) {\n"
    "      best = t;\n      hit = static_cast<int>(k);\n    }\n  };\n";

/// Names of the coordinates across and along an axis.
struct Names {
  std::string x, y, z;
};
Names names_of(int axis) {
  const auto name = [&](int i) { return std::string(1, "xyz"[(axis + i) % 3]); };
  return {name(1), name(2), name(0)};
}

/// Daughters beside the pattern: their tables, and the calls that visit them.
struct Others {
  std::string tables, at, along;
};
Others others_of(const ScenePlan& plan, const std::vector<std::uint32_t>& others,
                 const char* index) {
  Others text;
  if (others.size() <= few_others) {
    for (const std::uint32_t k : others) {
      text.at += "  visit(" + std::to_string(k) + "U);\n";
      text.along += "  visit(" + std::to_string(k) + "U);\n";
    }
    return text;
  }
  text.tables = "constexpr BoxBlock blocks[] = {\n";
  std::string daughters;
  const std::size_t blocks = (others.size() + box_lanes - 1) / box_lanes;
  for (std::size_t b = 0; b < blocks; ++b) {
    const auto daughter = [&](std::size_t lane) {
      const std::size_t i = b * box_lanes + lane;
      return i < others.size() ? static_cast<int>(others[i]) : -1;
    };
    text.tables += box_block([&](std::size_t lane) {
      const int k = daughter(lane);
      return k < 0 ? nullptr : &plan.boxes[static_cast<std::size_t>(k)];
    });
    daughters += b == 0 ? "{" : ",\n  {";
    for (std::size_t lane = 0; lane < box_lanes; ++lane) {
      daughters += (lane == 0 ? "" : ", ") + std::to_string(std::max(daughter(lane), 0));
    }
    daughters += "}";
  }
  text.tables +=
      std::string("};\nconstexpr ") + index + " in_block[][box_lanes] = {" + daughters + "};\n";
  const std::string count = std::to_string(blocks);
  text.at = "  visit_blocks_around(blocks, in_block, " + count + ", p, visit);\n";
  text.along = "  visit_blocks(blocks, in_block, 0, " + count +
               ", float_ray(p, d), 0, infinity<double>(), visit, reach);\n";
  return text;
}

std::string both(const std::string& at, const std::string& along) {
  return find_head + std::string(visits_at) + at + "  return found;\n}\n" + nearest_head +
         visits_along + along + "  return hit;\n}\n";
}

const char* truth(bool b) { return b ? "true" : "false"; }

std::string ring_tables(const Ring& ring, const std::string& n, const char* index) {
  std::string edges = "constexpr double edges_" + n + "[][2] = {";
  for (std::size_t s = 0; s < ring.edges.size(); ++s) {
    edges += (s == 0       ? "{"
              : s % 8 == 0 ? ",\n  {"
                           : ", {") +
             number(ring.edges[s][0]) + ", " + number(ring.edges[s][1]) + "}";
  }
  const std::size_t cells = ring.at_angle.size();
  const double near = std::max(ring.near, 0.0);
  return edges + "};\n" + list(index, "at_angle_" + n, ring.at_angle) +
         list("unsigned", "first_" + n, ring.first) + list(index, "members_" + n, ring.members) +
         "constexpr RingSectors<" + index + "> ring_" + n + "{" + number(near * near) + ", " +
         number(ring.far * ring.far) + ", " + number(ring.low) + ", " + number(ring.high) + ", " +
         truth(ring.hole) + ", " + truth(ring.outside) + ", " + truth(ring.ends) + ", " +
         std::to_string(ring.steps) + ", edges_" + n + ", at_angle_" + n + ", " +
         number(static_cast<double>(cells) / 4) + ", " + std::to_string(cells) + ", " +
         number(ring.reach) + ", first_" + n + ", members_" + n + "};\n";
}

}  // namespace

std::string SceneText::search_nest() const {
  const Nest& s = plan_.nest;
  const char* index = index_type(scene_.daughters.size());
  const Others others = others_of(plan_, s.others, index);
  const Names n = names_of(s.axis % 3);
  const std::string text = list("double", "near2", s.near2) + list("double", "far2", s.far2) +
                           list(index, "by_position", s.members) + "constexpr ShellNest<" + index +
                           "> shells{" + std::to_string(s.members.size()) +
                           ", near2, far2, by_position, " + truth(s.ends) + ", " + number(s.low) +
                           ", " + number(s.high) + "};\n" + others.tables;
  const std::string square = s.axis == 3
                                 ? "p.x * p.x + p.y * p.y + p.z * p.z"
                                 : "p." + n.x + " * p." + n.x + " + p." + n.y + " * p." + n.y;
  const std::string ray =
      s.axis == 3 ? "about_centre(p, d)"
                  : "about_axis(p." + n.x + ", p." + n.y + ", d." + n.x + ", d." + n.y + ")";
  std::string clip = "  double from = 0, to = infinity<double>();\n";
  if (s.ends) {
    clip += "  clip_to_ends(shells.low, shells.high, p." + n.z + ", d." + n.z + ", d.inverse_" +
            n.z + ", from, to);\n";
  }
  return text + both(others.at + "  visit_shells_at(shells, " + square + ", visit);\n",
                     others.along + clip + "  walk_shells(shells, " + ray +
                         ", from, to, visit, reach);\n");
}

std::string SceneText::search_rings() const {
  const Rings& r = plan_.rings;
  const char* index = index_type(scene_.daughters.size());
  const Others others = others_of(plan_, r.others, index);
  const Names n = names_of(r.axis);
  std::string tables = others.tables, at = others.at, along = others.along;
  along += "  const AxialRay ray{p." + n.x + ", p." + n.y + ", p." + n.z + ", d." + n.x + ", d." +
           n.y + ", d." + n.z + ", d.inverse_" + n.z + "};\n";
  for (std::size_t i = 0; i < r.rings.size(); ++i) {
    const std::string number_of = std::to_string(i);
    tables += ring_tables(r.rings[i], number_of, index);
    at += "  visit_sector_at(ring_" + number_of + ", p." + n.x + ", p." + n.y + ", p." + n.z +
          ", visit);\n";
    along += "  walk_ring(ring_" + number_of + ", ray, visit, reach);\n";
  }
  return tables + both(at, along);
}

}  // namespace navjit::codegen
