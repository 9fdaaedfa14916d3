#include "codegen/scene_text.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "codegen/text.hpp"
#include "geometry/solids/extent.hpp"

namespace navjit::codegen {
namespace {

std::string id(VolumeId volume) { return std::to_string(volume); }

/// r[0] * a + r[1] * b + r[2] * c without the terms that are exactly zero and the factors that are
/// exactly one: the sum keeps its order, and so its bits.
std::string row(const double* r, const char* a, const char* b, const char* c) {
  const char* names[3] = {a, b, c};
  std::string text;
  for (int i = 0; i < 3; ++i) {
    if (r[i] == 0) continue;
    if (!text.empty()) text += " + ";
    if (r[i] == 1) {
      text += names[i];
    } else if (r[i] == -1) {
      // What is negated may be a negative number: two signs in a row would be a decrement.
      text += std::string("-(") + names[i] + ")";
    } else {
      text += number(r[i]) + " * " + names[i];
    }
  }
  return text.empty() ? "0.0" : text;
}

/// Boxes have their sizes beside their positions.
bool boxes_from_table(const DaughterClass& c) {
  return c.from_table() && c.kind() == SolidKind::box;
}

/// The box beside a position, with the sizes that all share as constants.
std::string box_from_table(const DaughterClass& c) {
  const auto half = [](const DaughterClass::Shape& s, int axis) {
    const auto& box = *static_cast<const kernels::Box<double>*>(s.solid.shape);
    return axis == 0 ? box.hx : axis == 1 ? box.hy : box.hz;
  };
  std::string text = "Box<double>{";
  for (int axis = 0; axis < 3; ++axis) {
    const double first = half(c.shapes[0], axis);
    const bool same = std::all_of(c.shapes.begin(), c.shapes.end(),
                                  [&](const auto& s) { return half(s, axis) == first; });
    text +=
        (axis == 0 ? "" : ", ") + (same ? number(first) : "at.box.h" + std::string(1, "xyz"[axis]));
  }
  return text + "}";
}

std::string rows(const double* r, const char* a, const char* b, const char* c) {
  return row(r, a, b, c) + ", " + row(r + 3, a, b, c) + ", " + row(r + 6, a, b, c);
}

}  // namespace

SceneText::SceneText(const Geometry& geometry, const WorldFacts& facts, const ScenePlan& plan,
                     const Neighbours& neighbours, Shapes& shapes)
    : geometry_(geometry),
      facts_(facts),
      plan_(plan),
      neighbours_(neighbours),
      shapes_(shapes),
      scene_(geometry.scene(plan.volume)),
      ns_("scene_" + id(plan.volume)) {}

bool SceneText::leaf(VolumeId volume) const { return geometry_.scene(volume).daughters.empty(); }

// The scene's frame: what is the same for all its touchables is written as constants.
std::string SceneText::frame() const {
  const FrameFacts& f = plan_.frame;
  std::string t[3];
  for (int i = 0; i < 3; ++i) {
    t[i] = f.only_translation ? number((*f.only_translation)[i])
                              : "level.translation[" + std::to_string(i) + "]";
  }
  std::string text;
  // heading() serves relocation, ray() the step: it says whether the navigator takes the ray.
  const std::string heading_head =
      "static inline Direction<double> heading([[maybe_unused]] NavigationStack* stack, "
      "[[maybe_unused]] "
      "const StackLevel& level) {\n";
  const std::string ray_head =
      "static inline bool ray([[maybe_unused]] NavigationStack* stack, [[maybe_unused]] const "
      "StackLevel& "
      "level, Direction<double>& d) {\n";
  const char* const given =
      "  const double u = stack->ray.given[0], v = stack->ray.given[1], "
      "w = stack->ray.given[2];\n";
  const auto known_heading = [](const char* ray) {
    return std::string("const Direction<double>& d = stack->") + ray +
           ".direction;\n  return {d.x, d.y, d.z, d.x, d.x, d.x};\n";
  };
  const auto takes = [&](const char* oblique) {
    return std::string("  return ") + (plan_.oblique_only ? oblique : "true") + ";\n}\n";
  };
  if (!f.never_rotated && !f.only_rotation) {
    return "static inline Vec3<double> point(const StackLevel& level, double x, double y, double "
           "z) {\n"
           "  return to_local(level, x, y, z);\n}\n" +
           heading_head + given + "  return to_local_heading(level, u, v, w);\n}\n" + ray_head +
           given + "  d = to_local_direction(level, u, v, w);\n" + takes("is_oblique(d)");
  }
  text +=
      "static inline Vec3<double> point([[maybe_unused]] const StackLevel& level, double x, double "
      "y, "
      "double z) {\n";
  if (f.never_rotated) {
    text += "  if (level.rotation != nullptr) __builtin_unreachable();\n";
    text += "  return {x - " + t[0] + ", y - " + t[1] + ", z - " + t[2] + "};\n}\n";
    return text + heading_head + "  " + known_heading("ray") + "}\n" + ray_head +
           "  d = stack->ray.direction;\n" + takes("stack->ray.oblique");
  }
  const double* r = f.only_rotation->data();
  const std::string number_of_rotation = std::to_string(f.rotation);
  text += "  const double dx = x - " + t[0] + ", dy = y - " + t[1] + ", dz = z - " + t[2] + ";\n";
  text += "  return {" + rows(r, "dx", "dy", "dz") + "};\n}\n";
  text += heading_head + "  if (stack->turned.rotation == " + number_of_rotation + ") {\n    " +
          known_heading("turned") + "  }\n" + given + "  return make_heading<double>(" +
          rows(r, "u", "v", "w") + ");\n}\n";
  return text + ray_head + "  const TurnedRay& turned = turned_ray(stack, " + number_of_rotation +
         ", [&] {\n  " + given + "    return make_direction<double>(" + rows(r, "u", "v", "w") +
         ");\n  });\n  d = turned.direction;\n" + takes("turned.oblique");
}

/// The shapes of a class, and where it matters their boxes with a margin.
std::string SceneText::shape_table(const DaughterClass& c, std::size_t number_of_class) const {
  const std::string n = std::to_string(number_of_class);
  std::string text =
      "constexpr decltype(" + shapes_.constant(c.shapes[0].solid) + ") shapes_" + n + "[] = {";
  std::string boxes;
  for (const DaughterClass::Shape& s : c.shapes) {
    text += shapes_.constant(s.solid) + ", ";
    boxes += "  {" + margin_box(s.extent) + "},\n";
  }
  text += "};\n";
  if (c.box_first) text += "constexpr Vec3<double> boxes_" + n + "[][2] = {\n" + boxes + "};\n";
  return text;
}

/// The corners of a solid's box, inflated by far more than any rounding, far less than any
/// dimension.
std::string SceneText::margin_box(const Extent& e) const {
  const double scale = std::max(1.0, largest_coordinate(e));
  const double margin =
      2 * geometry_.tolerance() + 1e-9 * std::max(scale, geometry_.tolerance() * 1e9);
  return "{" + number(e.min.x - margin) + ", " + number(e.min.y - margin) + ", " +
         number(e.min.z - margin) + "}, {" + number(e.max.x + margin) + ", " +
         number(e.max.y + margin) + ", " + number(e.max.z + margin) + "}";
}

std::string SceneText::tables() const {
  std::string text =
      "struct Daughter {\n  double x, y, z;\n  unsigned long long offset;\n  unsigned volume;\n"
      "  unsigned short kind;\n  unsigned rotation;\n";
  text += "  unsigned short shape;\n";
  const bool boxes = std::any_of(plan_.classes.begin(), plan_.classes.end(), boxes_from_table);
  if (boxes) {
    shapes_.need(SolidKind::box);
    text += "  Box<double> box;\n";
  }
  text += "};\nconstexpr Daughter daughters[] = {\n";
  std::vector<std::uint32_t> kind(scene_.daughters.size()), shape(scene_.daughters.size());
  std::string tables;
  for (std::uint32_t c = 0; c < plan_.classes.size(); ++c) {
    const DaughterClass& of = plan_.classes[c];
    for (std::size_t i = 0; i < of.members.size(); ++i) {
      kind[of.members[i]] = c;
      shape[of.members[i]] = of.shape_of[i];
    }
    if (of.from_table() && !boxes_from_table(of)) tables += shape_table(of, c);
  }
  std::string rotations;
  std::vector<std::array<double, 9>> distinct;
  for (std::uint32_t k = 0; k < scene_.daughters.size(); ++k) {
    const Daughter& d = scene_.daughters[k];
    const Transformation& t = d.transformation;
    std::size_t rotation = 0;
    if (t.rotated) {
      std::array<double, 9> r;
      std::copy_n(t.rotation, 9, r.begin());
      rotation = static_cast<std::size_t>(std::find(distinct.begin(), distinct.end(), r) -
                                          distinct.begin());
      if (rotation == distinct.size()) {
        distinct.push_back(r);
        rotations += "  {";
        for (int i = 0; i < 9; ++i) rotations += (i == 0 ? "" : ", ") + number(r[i]);
        rotations += "},\n";
      }
    }
    text += "  {" + number(t.translation[0]) + ", " + number(t.translation[1]) + ", " +
            number(t.translation[2]) + ", " + std::to_string(d.offset) + "ULL, " + id(d.volume) +
            ", " + std::to_string(kind[k]) + ", " + std::to_string(rotation) + ", " +
            std::to_string(shape[k]);
    if (boxes && d.solid.kind == SolidKind::box) {
      const auto& box = *static_cast<const kernels::Box<double>*>(d.solid.shape);
      text += ", {" + number(box.hx) + ", " + number(box.hy) + ", " + number(box.hz) + "}";
    } else if (boxes) {
      text += ", {0, 0, 0}";
    }
    text += "},\n";
  }
  text += "};\n" + tables;
  if (!rotations.empty()) text += "constexpr double rotations[][9] = {\n" + rotations + "};\n";
  return text;
}

/// `call` with the daughter's local point q and direction e in place.
std::string SceneText::daughter_case(const DaughterClass& c, const char* call, const std::string& x,
                                     const std::string& y, const std::string& z,
                                     const std::string& rotation) const {
  // What all members share folds.
  const auto shared = [&](int axis, const std::string& variable) {
    const double first = scene_.daughters[c.members[0]].transformation.translation[axis];
    const bool same = std::all_of(c.members.begin(), c.members.end(), [&](std::uint32_t k) {
      return scene_.daughters[k].transformation.translation[axis] == first;
    });
    return same ? "(" + number(first) + ")" : variable;
  };
  std::string text = "{\n      const double dx = p.x - " + shared(0, x) + ", dy = p.y - " +
                     shared(1, y) + ", dz = p.z - " + shared(2, z) + ";\n";
  const bool directed = std::string_view(call) != "safety_to_in";
  const std::string make = std::string_view(call) == "contains" ? "make_heading" : "make_direction";
  if (!c.rotated) {
    text += "      const Vec3<double> q{dx, dy, dz};\n";
    if (directed) text += "      const Direction<double>& e = d;\n";
  } else if (c.members.size() == 1) {
    const double* r = scene_.daughters[c.members[0]].transformation.rotation;
    text += "      const Vec3<double> q{" + rows(r, "dx", "dy", "dz") + "};\n";
    if (directed) {
      text += "      const Direction<double> e = " + make + "<double>(" +
              rows(r, "d.x", "d.y", "d.z") + ");\n";
    }
  } else {
    text += "      const double* r = rotations[" + rotation + "];\n";
    text +=
        "      const Vec3<double> q{r[0] * dx + r[1] * dy + r[2] * dz, r[3] * dx + r[4] * dy "
        "+ r[5] * dz, r[6] * dx + r[7] * dy + r[8] * dz};\n";
    if (directed) {
      text += "      const Direction<double> e = " + make +
              "<double>(r[0] * d.x + r[1] * d.y + "
              "r[2] * d.z, r[3] * d.x + r[4] * d.y + r[5] * d.z, r[6] * d.x + r[7] * d.y + r[8] * "
              "d.z);\n";
    }
  }
  const std::string n = std::to_string(&c - plan_.classes.data());
  const std::string solid = boxes_from_table(c) ? box_from_table(c)
                            : c.from_table()    ? "shapes_" + n + "[at.shape]"
                                                : shapes_.constant(c.shapes[0].solid);
  if (!directed) return text + "      return safety_to_in(" + solid + ", q);\n    }\n";
  if (c.box_first) {
    const std::string box =
        (c.from_table() ? "boxes_" + n + "[at.shape][0], boxes_" + n + "[at.shape][1]"
                        : margin_box(c.shapes[0].extent)) +
        ", q";
    text += std::string_view(call) == "distance_to_in"
                ? "      if (!may_meet_box(" + box + ", e, reach)) return infinity<double>();\n"
                : "      if (!is_in_box(" + box + ")) return false;\n";
  }
  const bool put_off = plan_.bail_out_rare && std::string_view(call) == "distance_to_in" &&
                       !(c.rotated && c.kind() == SolidKind::box);
  return text + "      return " + (put_off ? "distance_to_entry" : call) + "(" + solid +
         ", q, e, tolerance);\n    }\n";
}

/// Pushes daughter `at` placed by translation alone, with what is the same for all daughters and
/// all touchables as constants. Terms that are zero may be left out: no translation is negative
/// zero, so that the sign of a sum that is zero does not matter.
std::string SceneText::push_translation() const {
  const FrameFacts& f = plan_.frame;
  if (!f.never_rotated && !f.only_rotation) {
    return "push_translated(stack, at.volume, k, at.offset, at.x, at.y, at.z);\n";
  }
  const char* const field[3] = {"at.x", "at.y", "at.z"};
  std::string moved[3];  // empty: by nothing
  bool one_volume = true;
  for (int i = 0; i < 3; ++i) {
    const double first = scene_.daughters[0].transformation.translation[i];
    bool same = true;
    for (const Daughter& d : scene_.daughters) {
      same &= d.transformation.translation[i] == first;
      one_volume &= d.volume == scene_.daughters[0].volume;
    }
    if (!same || first != 0) moved[i] = same ? number(first) : field[i];
  }
  std::string text =
      "const StackLevel& mother = stack->levels[stack->depth];\n"
      "  StackLevel& level = stack->levels[++stack->depth];\n";
  for (int i = 0; i < 3; ++i) {
    std::string by = moved[i];
    if (f.only_rotation) {
      double column[3];
      for (int j = 0; j < 3; ++j) {
        column[j] = moved[j].empty() ? 0 : (*f.only_rotation)[static_cast<std::size_t>(3 * j + i)];
      }
      by = row(column, moved[0].c_str(), moved[1].c_str(), moved[2].c_str());
      if (by == "0.0") by.clear();
    }
    const std::string axis = std::to_string(i);
    text += "  level.translation[" + axis + "] = mother.translation[" + axis + "]" +
            (by.empty() ? "" : " + (" + by + ")") + ";\n";
  }
  return text + "  level.rotation = " + (f.never_rotated ? "nullptr" : "mother.rotation") +
         ";\n  level.touchable = mother.touchable + at.offset;\n  level.volume = " +
         (one_volume ? id(scene_.daughters[0].volume) : std::string("at.volume")) +
         ";\n  level.daughter = k;\n";
}

std::string SceneText::push() const {
  bool any = false, every = true;
  for (const DaughterClass& c : plan_.classes) {
    any |= c.rotated;
    every &= c.rotated;
  }
  const std::string translated = push_translation();
  const std::string rotated =
      "push_rotated(stack, at.volume, k, at.offset, at.x, at.y, at.z, rotations[at.rotation]);\n";
  std::string text =
      "static inline void push(NavigationStack* stack, unsigned k) {\n"
      "  const Daughter& at = daughters[k];\n";
  if (plan_.frame.never_rotated && any) {
    text += "  if (stack->levels[stack->depth].rotation != nullptr) __builtin_unreachable();\n";
  }
  if (!any) return text + "  " + translated + "}\n";
  if (every) return text + "  " + rotated + "}\n";
  std::string which;
  for (std::size_t c = 0; c < plan_.classes.size(); ++c) {
    if (!plan_.classes[c].rotated) continue;
    which += (which.empty() ? "" : " || ") + std::string("at.kind == ") + std::to_string(c);
  }
  return text + "  if (" + which + ") {\n    " + rotated + "  } else {\n    " + translated +
         "  }\n}\n";
}

}  // namespace navjit::codegen
