// Relocation and steps of a scene: what its searches are for.
#include <algorithm>

#include "codegen/scene_text.hpp"

namespace navjit::codegen {
namespace {

const char* const point_arguments = "double x, double y, double z";
const char* const point_values = "x, y, z";

std::string id(VolumeId volume) { return std::to_string(volume); }

}  // namespace

std::string SceneText::enter_declaration() const {
  return "[[gnu::noinline]] static void enter_" + id(plan_.volume) +
         "(NavigationStack* stack, const Context* context, " + point_arguments + ");\n";
}

std::string SceneText::reenter_declaration() const {
  return "[[gnu::noinline]] static void reenter_" + id(plan_.volume) +
         "(NavigationStack* stack, const Context* context, " + point_arguments +
         ", unsigned blocked);\n";
}

/// Into the daughter just pushed, and further down.
std::string SceneText::descend() const {
  std::string text =
      "static inline void descend([[maybe_unused]] NavigationStack* stack, [[maybe_unused]] const "
      "Context* context, [[maybe_unused]] unsigned k";
  for (const char* name : {"x", "y", "z"}) {
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
  text += table ? std::string("relocate_in_table(stack, context, daughters[k].volume, ") +
                      point_values + ", -1); return;\n"
                : "__builtin_unreachable();\n";
  return text + "  }\n}\n";
}

std::string SceneText::enter() const {
  std::string text = "[[gnu::noinline]] static void enter_" + id(plan_.volume) +
                     "(NavigationStack* stack, const Context* context, " + point_arguments +
                     ") {\n";
  text +=
      "  const StackLevel& level = stack->levels[stack->depth];\n"
      "  const int k = " +
      ns_ + "::find(" + ns_ + "::point(level, x, y, z), " + ns_ +
      "::heading(stack, level), -1);\n"
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
               "  relocate_in_table(stack, context, outer.volume, ") +
           point_values + ", static_cast<int>(" + blocked + "));\n";
  }
  const VolumeId mother = *plan_.only_mother;
  if (const VolumeId first = facts_.first_equal[mother]; neighbours_.reenter.contains(first)) {
    return "  --stack->depth;\n  reenter_" + id(first) + "(stack, context, " + point_values + ", " +
           blocked + ");\n";
  }
  return "  --stack->depth;\n  relocate_in_table(stack, context, " + id(mother) + ", " +
         point_values + ", static_cast<int>(" + blocked + "));\n";
}

std::string SceneText::reenter() const {
  std::string text = "[[gnu::noinline]] static void reenter_" + id(plan_.volume) +
                     "(NavigationStack* stack, const Context* context, " + point_arguments +
                     ", unsigned blocked) {\n  using namespace " + ns_ +
                     ";\n"
                     "  const StackLevel& level = stack->levels[stack->depth];\n"
                     "  const Vec3<double> p = point(level, x, y, z);\n"
                     "  const Direction<double> d = heading(stack, level);\n";
  if (plan_.neighbour_lists) {
    text +=
        "  const NeighbourList& left_from = lists[blocked];\n"
        "  const bool there = is_there(left_from, p);\n";
  }
  text += plan_.neighbour_lists ? "  if (!(there && left_from.mother_contains) && !contains("
                                : "  if (!contains(";
  text += shapes_.constant(scene_.solid) +
          ", p, d, tolerance)) {\n"
          "  [[maybe_unused]] const unsigned left = level.daughter;\n" +
          leave_to_mother("left") + "    return;\n  }\n";
  text +=
      plan_.neighbour_lists
          ? "  const int k = find_neighbour(left_from, there, p, d, static_cast<int>(blocked));\n"
          : "  const int k = find(p, d, static_cast<int>(blocked));\n";
  return text +
         "  if (k < 0) return;\n"
         "  push(stack, static_cast<unsigned>(k));\n"
         "  descend(stack, context, static_cast<unsigned>(k), " +
         point_values + ");\n}\n";
}

std::string SceneText::step(const std::string& symbol) const {
  std::string text =
      "extern \"C\" double " + symbol +
      "(NavigationStack* stack, [[maybe_unused]] const Context* context, const void*, " +
      point_arguments + ", double limit) {\n";
  text +=
      "  const StackLevel& level = stack->levels[stack->depth];\n"
      "  const Vec3<double> p = " +
      ns_ +
      "::point(level, x, y, z);\n"
      "  Direction<double> d;\n"
      "  if (__builtin_expect(!" +
      ns_ +
      "::ray(stack, level, d), 0)) return -1.0;\n"
      "  double best = " +
      (plan_.bail_out_rare ? "distance_to_exit" : "distance_to_out") + "(" +
      shapes_.constant(scene_.solid) + ", p, d, tolerance);\n";
  const bool daughters = !scene_.daughters.empty();
  if (daughters)
    text += "  const int hit = " + ns_ +
            "::nearest(p, d, best, limit, stack->levels[stack->depth + 1].daughter);\n";
  // Steps of length zero are relocated with more care than pays here, and those from within a
  // daughter have a kernel that does not either.
  text +=
      "  if (__builtin_expect(!(best > 0), 0)) return -1.0;\n"
      "  if (best > limit) {\n    stack->boundary = 0;\n    return limit;\n  }\n"
      "  stack->boundary = 1;\n"
      "  x += best * stack->ray.given[0];\n  y += best * stack->ray.given[1];\n"
      "  z += best * stack->ray.given[2];\n";
  if (daughters) {
    text += "  if (hit >= 0) {\n    const unsigned k = static_cast<unsigned>(hit);\n    " + ns_ +
            "::push(stack, k);\n    " + ns_ + "::descend(stack, context, k, " + point_values +
            ");\n    return best;\n  }\n";
  }
  text += "  [[maybe_unused]] const unsigned left = level.daughter;\n" + leave_to_mother("left") +
          "  return best;\n}\n";
  return text;
}

std::string SceneText::relocate(const std::string& symbol) const {
  std::string text = "extern \"C\" void " + symbol +
                     "([[maybe_unused]] NavigationStack* stack, [[maybe_unused]] const Context* "
                     "context, const void*";
  for (const char* name : {"x", "y", "z"}) {
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
