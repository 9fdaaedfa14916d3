// The safety of a scene: the generic navigator's formula, with constants.
#include "codegen/scene_text.hpp"
#include "codegen/text.hpp"

namespace navjit::codegen {

std::string SceneText::safety(const std::string& symbol) const {
  std::string text = "namespace " + ns_ + " {\n";
  const std::size_t count = scene_.daughters.size();
  if (count > 0) {
    text +=
        "[[gnu::always_inline]] static inline double away(unsigned k, const Vec3<double>& p) {\n" +
        daughter_switch("safety_to_in");
  }
  if (plan_.safety == SafetyFrom::boxes) {
    text += "constexpr BoxBlock around_all[] = {\n";
    for (std::size_t first = 0; first < count; first += box_lanes) {
      text += box_block([&](std::size_t lane) {
        return first + lane < count ? &plan_.tree_boxes[first + lane] : nullptr;
      });
    }
    text += "};\n";
  }
  text += "}  // namespace " + ns_ + "\nextern \"C\" double " + symbol +
          "(const NavigationStack* stack, const Context*, const void*, double x, double y, double "
          "z) {\n"
          "  using namespace " +
          ns_ +
          ";\n  const Vec3<double> p = point(stack->levels[stack->depth], x, y, z);\n"
          "  double safety = safety_to_out(" +
          shapes_.constant(scene_.solid) + ", p);\n";
  if (plan_.safety == SafetyFrom::boxes) {
    text += "  safety = safety_among_boxes(around_all, " +
            std::to_string((count + box_lanes - 1) / box_lanes) +
            ", p, safety, [&](unsigned k) { return away(k, p); });\n";
  } else {
    for (std::size_t k = 0; k < count; ++k) {
      text += "  safety = smaller(larger(away(" + std::to_string(k) + ", p), 0.0), safety);\n";
    }
  }
  return text + "  return larger(safety - tolerance, 0.0);\n}\n";
}

}  // namespace navjit::codegen
