#include "codegen/scene_text.hpp"

#include <algorithm>
#include <cmath>

#include "codegen/text.hpp"

namespace navjit::codegen {
namespace {

const char* const point_arguments = "double x, double y, double z, double u, double v, double w";
const char* const point_values = "x, y, z, u, v, w";

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
      text += std::string("-") + names[i];
    } else {
      text += number(r[i]) + " * " + names[i];
    }
  }
  return text.empty() ? "0.0" : text;
}

std::string rows(const double* r, const char* a, const char* b, const char* c) {
  return row(r, a, b, c) + ", " + row(r + 3, a, b, c) + ", " + row(r + 6, a, b, c);
}

std::string list(const char* type, const char* name, const std::vector<std::uint32_t>& values) {
  std::string text = std::string("constexpr ") + type + " " + name + "[] = {";
  for (std::size_t i = 0; i < values.size(); ++i) {
    text += (i == 0 ? "" : i % 24 == 0 ? ",\n  " : ", ") + std::to_string(values[i]);
  }
  return text + (values.empty() ? "0};\n" : "};\n");
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

std::string SceneText::enter_declaration() const {
  return "[[gnu::noinline]] static void enter_" + id(plan_.volume) +
         "(Stack* stack, const Context* context, " + point_arguments + ");\n";
}

std::string SceneText::reenter_declaration() const {
  return "[[gnu::noinline]] static void reenter_" + id(plan_.volume) +
         "(Stack* stack, const Context* context, " + point_arguments + ", unsigned blocked);\n";
}

// The scene's frame: what is the same for all its touchables is written as constants.
std::string SceneText::frame() const {
  const FrameFacts& f = plan_.frame;
  std::string t[3];
  for (int i = 0; i < 3; ++i) {
    t[i] = f.only_translation ? number((*f.only_translation)[i])
                              : "level.translation[" + std::to_string(i) + "]";
  }
  std::string text;
  if (!f.never_rotated && !f.only_rotation) {
    return "static inline Vec3<double> point(const StackLevel& level, double x, double y, double "
           "z) {\n"
           "  return to_local(level, x, y, z);\n}\n"
           "static inline Direction<double> direction(const StackLevel& level, double u, double v, "
           "double w) {\n  return to_local_direction(level, u, v, w);\n}\n"
           "static inline Direction<double> ray(Stack*, const StackLevel& level, double u, double "
           "v, double w) {\n  return direction(level, u, v, w);\n}\n";
  }
  text +=
      "static inline Vec3<double> point([[maybe_unused]] const StackLevel& level, double x, double "
      "y, "
      "double z) {\n";
  if (f.never_rotated) {
    text += "  if (level.rotation != nullptr) __builtin_unreachable();\n";
    text += "  return {x - " + t[0] + ", y - " + t[1] + ", z - " + t[2] + "};\n}\n";
    text +=
        "static inline Direction<double> direction(const StackLevel&, double u, double v, double "
        "w) {\n"
        "  return make_direction<double>(u, v, w);\n}\n"
        "static inline Direction<double> ray(Stack* stack, const StackLevel&, double u, double v, "
        "double w) {\n  return ray_direction(stack->ray, u, v, w);\n}\n";
    return text;
  }
  text += "  const double dx = x - " + t[0] + ", dy = y - " + t[1] + ", dz = z - " + t[2] + ";\n";
  text += "  return {" + rows(f.only_rotation->data(), "dx", "dy", "dz") + "};\n}\n";
  text +=
      "static inline Direction<double> direction(const StackLevel&, double u, double v, double w) "
      "{\n"
      "  return make_direction<double>(" +
      rows(f.only_rotation->data(), "u", "v", "w") + ");\n}\n";
  text +=
      "static inline Direction<double> ray(Stack* stack, const StackLevel& level, double u, double "
      "v, double w) {\n  return turned_direction(stack->turned, " +
      std::to_string(f.rotation) + ", u, v, w, [&] { return direction(level, u, v, w); });\n}\n";
  return text;
}

std::string SceneText::tables() const {
  std::string text =
      "struct Daughter {\n  double x, y, z;\n  unsigned long long offset;\n  unsigned volume;\n"
      "  unsigned short kind;\n  unsigned rotation;\n};\n"
      "constexpr Daughter daughters[] = {\n";
  std::vector<std::uint32_t> kind(scene_.daughters.size());
  for (std::uint32_t c = 0; c < plan_.classes.size(); ++c) {
    for (const std::uint32_t k : plan_.classes[c].members) kind[k] = c;
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
            ", " + std::to_string(kind[k]) + ", " + std::to_string(rotation) + "},\n";
  }
  text += "};\n";
  if (!rotations.empty()) text += "constexpr double rotations[][9] = {\n" + rotations + "};\n";
  return text;
}

/// `call` with the daughter's local point q and direction e in place.
std::string SceneText::daughter_case(const DaughterClass& c, const char* call, const std::string& x,
                                     const std::string& y, const std::string& z,
                                     const std::string& rotation) const {
  std::string text =
      "{\n      const double dx = p.x - " + x + ", dy = p.y - " + y + ", dz = p.z - " + z + ";\n";
  if (!c.rotated) {
    text += "      const Vec3<double> q{dx, dy, dz};\n      const Direction<double>& e = d;\n";
  } else if (c.members.size() == 1) {
    const double* r = scene_.daughters[c.members[0]].transformation.rotation;
    text += "      const Vec3<double> q{" + rows(r, "dx", "dy", "dz") + "};\n";
    text += "      const Direction<double> e = make_direction<double>(" +
            rows(r, "d.x", "d.y", "d.z") + ");\n";
  } else {
    text += "      const double* r = rotations[" + rotation + "];\n";
    text +=
        "      const Vec3<double> q{r[0] * dx + r[1] * dy + r[2] * dz, r[3] * dx + r[4] * dy "
        "+ r[5] * dz, r[6] * dx + r[7] * dy + r[8] * dz};\n"
        "      const Direction<double> e = make_direction<double>(r[0] * d.x + r[1] * d.y + "
        "r[2] * d.z, r[3] * d.x + r[4] * d.y + r[5] * d.z, r[6] * d.x + r[7] * d.y + r[8] * "
        "d.z);\n";
  }
  const std::string solid = shapes_.constant(c.solid);
  if (std::string_view(call) == "distance_to_in" && c.box_first) {
    const Extent& e = c.extent;
    double scale = 1;
    for (const double b : {e.min.x, e.min.y, e.min.z, e.max.x, e.max.y, e.max.z}) {
      scale = std::max(scale, std::abs(b));
    }
    // As for buckets: far above any rounding, far below any dimension.
    const double margin =
        2 * geometry_.tolerance() + 1e-9 * std::max(scale, geometry_.tolerance() * 1e9);
    text += "      if (!may_meet_box({" + number(e.min.x - margin) + ", " +
            number(e.min.y - margin) + ", " + number(e.min.z - margin) + "}, {" +
            number(e.max.x + margin) + ", " + number(e.max.y + margin) + ", " +
            number(e.max.z + margin) + "}, q, e, reach)) return infinity<double>();\n";
  }
  return text + "      return " + call + "(" + solid + ", q, e, tolerance);\n    }\n";
}

std::string SceneText::search() const {
  const std::string mother = shapes_.constant(scene_.solid);
  std::string text = "namespace " + ns_ + " {\n" + frame();
  if (scene_.daughters.empty()) return text + "}  // namespace " + ns_ + "\n";
  text += tables();
  const bool one = plan_.classes.size() == 1;
  for (const char* call : {"contains", "distance_to_in"}) {
    const bool distance = std::string_view(call) == "distance_to_in";
    text +=
        std::string(distance ? "static inline double distance(unsigned k, const Vec3<double>& p, "
                               "const Direction<double>& d, [[maybe_unused]] double reach) {\n"
                             : "static inline bool holds(unsigned k, const Vec3<double>& p, const "
                               "Direction<double>& d) {\n");
    text += "  const Daughter& at = daughters[k];\n";
    if (!one) text += "  switch (at.kind) {\n";
    for (std::size_t c = 0; c < plan_.classes.size(); ++c) {
      if (!one) {
        text += c + 1 == plan_.classes.size() ? "    default: "
                                              : "    case " + std::to_string(c) + ": ";
      } else {
        text += "    ";
      }
      text += daughter_case(plan_.classes[c], call, "at.x", "at.y", "at.z", "at.rotation");
    }
    text += one ? "}\n" : "  }\n}\n";
  }
  // Searches. Spelled-out daughters unroll: the index is a constant at each call.
  const std::string n = std::to_string(scene_.daughters.size());
  if (plan_.candidates == Candidates::all) {
    text +=
        "static inline int find(const Vec3<double>& p, const Direction<double>& d, int blocked) "
        "{\n";
    for (std::size_t k = scene_.daughters.size(); k-- > 0;) {
      const std::string i = std::to_string(k);
      text += "  if (blocked != " + i + " && holds(" + i + ", p, d)) return " + i + ";\n";
    }
    text += "  return -1;\n}\n";
    text +=
        "static inline int nearest(const Vec3<double>& p, const Direction<double>& d, double& "
        "best, "
        "double limit) {\n  int hit = -1;\n";
    for (std::size_t k = 0; k < scene_.daughters.size(); ++k) {
      const std::string i = std::to_string(k);
      text += "  if (const double t = distance(" + i +
              ", p, d, smaller(limit, best)); t < best) {\n    best = t;\n    hit = " + i +
              ";\n  }\n";
    }
    text += "  return hit;\n}\n";
  } else {
    const Buckets& b = plan_.buckets;
    const char* index = scene_.daughters.size() <= 0xffff ? "unsigned short" : "unsigned";
    text += list("unsigned", "first", b.first) + list(index, "members", b.members);
    text += std::string("constexpr BucketGrid<") + index + "> grid{{";
    for (int a = 0; a < 3; ++a) text += (a == 0 ? "" : ", ") + std::to_string(b.count[a]);
    text += "}, {";
    for (int a = 0; a < 3; ++a) text += (a == 0 ? "" : ", ") + number(b.origin[a]);
    text += "}, {";
    for (int a = 0; a < 3; ++a) text += (a == 0 ? "" : ", ") + number(b.width[a]);
    text += "}, {";
    for (int a = 0; a < 3; ++a) text += (a == 0 ? "" : ", ") + number(1 / b.width[a]);
    text += "}, first, members};\n";
    text +=
        "static inline int find(const Vec3<double>& p, const Direction<double>& d, int blocked) {\n"
        "  int found = -1;\n"
        "  visit_bucket_at(grid, p, [&](unsigned k) {\n"
        "    if (static_cast<int>(k) == blocked || !holds(k, p, d)) return true;\n"
        "    found = static_cast<int>(k);\n"
        "    return false;\n  });\n  return found;\n}\n";
    text +=
        "static inline int nearest(const Vec3<double>& p, const Direction<double>& d, double& "
        "best, "
        "double limit) {\n  int hit = -1;\n"
        "  walk_buckets(grid, p, d, [&](unsigned k) {\n"
        "    const double t = distance(k, p, d, smaller(limit, best));\n"
        "    if (t < best || (t == best && hit >= 0 && static_cast<int>(k) < hit)) {\n"
        "      best = t;\n      hit = static_cast<int>(k);\n    }\n"
        "  }, [&] { return smaller(limit, best); });\n  return hit;\n}\n";
  }
  return text + push() + descend() + "}  // namespace " + ns_ + "\n";
}

std::string SceneText::push() const {
  bool any = false, every = true;
  for (const DaughterClass& c : plan_.classes) {
    any |= c.rotated;
    every &= c.rotated;
  }
  const std::string translated =
      "push_translated(stack, at.volume, k, at.offset, at.x, at.y, at.z);\n";
  const std::string rotated =
      "push_rotated(stack, at.volume, k, at.offset, at.x, at.y, at.z, rotations[at.rotation]);\n";
  std::string text =
      "static inline void push(Stack* stack, unsigned k) {\n"
      "  const Daughter& at = daughters[k];\n";
  if (plan_.frame.never_rotated) {
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

/// Into the daughter just pushed, and further down.
std::string SceneText::descend() const {
  std::string text =
      "static inline void descend([[maybe_unused]] Stack* stack, [[maybe_unused]] const "
      "Context* context, [[maybe_unused]] unsigned k";
  for (const char* name : {"x", "y", "z", "u", "v", "w"}) {
    text += std::string(", [[maybe_unused]] double ") + name;
  }
  text += ") {\n";
  std::set<VolumeId> volumes;
  for (const Daughter& d : scene_.daughters) volumes.insert(d.volume);
  bool table = false;
  std::string cases;
  for (const VolumeId volume : volumes) {
    if (leaf(volume)) {
      cases += "    case " + id(volume) + ": return;\n";
    } else if (const VolumeId first = facts_.first_equal[volume];
               neighbours_.enter.contains(first)) {
      cases += "    case " + id(volume) + ": enter_" + id(first) + "(stack, context, " +
               point_values + "); return;\n";
    } else {
      table = true;
    }
  }
  const bool all_leaves =
      std::all_of(volumes.begin(), volumes.end(), [&](VolumeId v) { return leaf(v); });
  if (all_leaves) return text + "}\n";
  text += "  switch (daughters[k].volume) {\n";
  // Long lists of leaves are better told by the table's own entry than by a jump table.
  if (volumes.size() <= 24)
    text += cases;
  else
    table = true;
  text += "    default: ";
  text += table ? std::string(
                      "navigators_of(context, daughters[k].volume)->settle(stack, "
                      "context, ") +
                      point_values + ", -1); return;\n"
                : "__builtin_unreachable();\n";
  return text + "  }\n}\n";
}

std::string SceneText::enter() const {
  std::string text = "[[gnu::noinline]] static void enter_" + id(plan_.volume) +
                     "(Stack* stack, const Context* context, " + point_arguments + ") {\n";
  text +=
      "  const StackLevel& level = stack->levels[stack->depth];\n"
      "  const int k = " +
      ns_ + "::find(" + ns_ + "::point(level, x, y, z), " + ns_ +
      "::direction(level, u, v, w), -1);\n"
      "  if (k < 0) return;\n"
      "  " +
      ns_ +
      "::push(stack, static_cast<unsigned>(k));\n"
      "  " +
      ns_ + "::descend(stack, context, static_cast<unsigned>(k), " + point_values + ");\n}\n";
  return text;
}

/// The stack's innermost level has been left: pops it and relocates in its mother. `blocked` is the
/// index of the volume left.
std::string SceneText::leave_to_mother(const char* blocked) const {
  if (!plan_.only_mother) {
    if (plan_.volume == geometry_.world().top) return "  --stack->depth;\n";
    return std::string(
               "  const StackLevel& outer = stack->levels[--stack->depth];\n"
               "  navigators_of(context, outer.volume)->settle(stack, context, ") +
           point_values + ", static_cast<int>(" + blocked + "));\n";
  }
  const VolumeId mother = *plan_.only_mother;
  if (const VolumeId first = facts_.first_equal[mother]; neighbours_.reenter.contains(first)) {
    return "  --stack->depth;\n  reenter_" + id(first) + "(stack, context, " + point_values + ", " +
           blocked + ");\n";
  }
  return "  --stack->depth;\n  navigators_of(context, " + id(mother) +
         ")->settle(stack, context, " + point_values + ", static_cast<int>(" + blocked + "));\n";
}

std::string SceneText::reenter() const {
  std::string text = "[[gnu::noinline]] static void reenter_" + id(plan_.volume) +
                     "(Stack* stack, const Context* context, " + point_arguments +
                     ", unsigned blocked) {\n";
  text +=
      "  const StackLevel& level = stack->levels[stack->depth];\n"
      "  const Vec3<double> p = " +
      ns_ +
      "::point(level, x, y, z);\n"
      "  const Direction<double> d = " +
      ns_ +
      "::direction(level, u, v, w);\n"
      "  if (!contains(" +
      shapes_.constant(scene_.solid) +
      ", p, d, tolerance)) {\n"
      "  [[maybe_unused]] const unsigned left = level.daughter;\n" +
      leave_to_mother("left") +
      "    return;\n  }\n"
      "  const int k = " +
      ns_ +
      "::find(p, d, static_cast<int>(blocked));\n"
      "  if (k < 0) return;\n"
      "  " +
      ns_ +
      "::push(stack, static_cast<unsigned>(k));\n"
      "  " +
      ns_ + "::descend(stack, context, static_cast<unsigned>(k), " + point_values + ");\n}\n";
  return text;
}

std::string SceneText::step(const std::string& symbol) const {
  std::string text = "extern \"C\" double " + symbol +
                     "(Stack* stack, [[maybe_unused]] const Context* context, " + point_arguments +
                     ", double limit) {\n";
  text +=
      "  const StackLevel& level = stack->levels[stack->depth];\n"
      "  const Vec3<double> p = " +
      ns_ +
      "::point(level, x, y, z);\n"
      "  const Direction<double> d = " +
      ns_ +
      "::ray(stack, level, u, v, w);\n"
      "  double best = distance_to_out(" +
      shapes_.constant(scene_.solid) + ", p, d, tolerance);\n";
  const bool daughters = !scene_.daughters.empty();
  if (daughters) text += "  const int hit = " + ns_ + "::nearest(p, d, best, limit);\n";
  // Steps of length zero are relocated with more care than pays here.
  text +=
      "  if (best == 0) return -1.0;\n"
      "  if (best > limit) {\n    stack->boundary = 0;\n    return limit;\n  }\n"
      "  stack->boundary = 1;\n"
      "  x += best * u;\n  y += best * v;\n  z += best * w;\n";
  if (daughters) {
    text += "  if (hit >= 0) {\n    const unsigned k = static_cast<unsigned>(hit);\n    " + ns_ +
            "::push(stack, k);\n    " + ns_ + "::descend(stack, context, k, " + point_values +
            ");\n    return best;\n  }\n";
  }
  text += "  [[maybe_unused]] const unsigned left = level.daughter;\n" + leave_to_mother("left") +
          "  return best;\n}\n";
  return text;
}

std::string SceneText::settle(const std::string& symbol) const {
  std::string text = "extern \"C\" void " + symbol +
                     "([[maybe_unused]] Stack* stack, [[maybe_unused]] const Context* context";
  for (const char* name : {"x", "y", "z", "u", "v", "w"}) {
    text += std::string(", [[maybe_unused]] double ") + name;
  }
  text += ", [[maybe_unused]] int blocked) {\n";
  if (!scene_.daughters.empty()) {
    text += "  if (blocked < 0) {\n    enter_" + id(plan_.volume) + "(stack, context, " +
            point_values + ");\n  } else {\n    reenter_" + id(plan_.volume) + "(stack, context, " +
            point_values + ", static_cast<unsigned>(blocked));\n  }\n";
  }
  return text + "}\n";
}

}  // namespace navjit::codegen
