#include "codegen/data/bind.hpp"

#include <algorithm>

#include "codegen/data/instances.hpp"
#include "geometry/navigation/generic.hpp"

namespace navjit::codegen {

bool all_boxes(const Scene& scene) {
  return std::all_of(scene.daughters.begin(), scene.daughters.end(), [](const Daughter& d) {
    return d.solid.kind == SolidKind::box && !d.transformation.rotated;
  });
}

bool all_of_kind(const Scene& scene, SolidKind kind) {
  return std::all_of(scene.daughters.begin(), scene.daughters.end(),
                     [&](const Daughter& d) { return d.solid.kind == kind; });
}

kernels::SafetyFunction detail::generic_safety() { return generic::dispatch_entry.safety; }

const kernels::DispatchEntry* bind_to_data(const Geometry& geometry, const ScenePlan& plan,
                                           Arena& arena, const CodeOfSolids* code) {
  const Source source{geometry, plan, geometry.scene(plan.volume), arena, code};
  if (plan.frame.never_rotated) return bind_unrotated(source);
  if (plan.frame.only_rotation) return bind_turned(source);
  return bind_any_frame(source);
}

std::string structure_of(const Geometry& geometry, const ScenePlan& plan) {
  const Scene& scene = geometry.scene(plan.volume);
  std::string text = plan.frame.never_rotated   ? "unrotated "
                     : plan.frame.only_rotation ? "turned "
                                                : "";
  text += scene.solid.kind == SolidKind::box    ? "box"
          : scene.solid.kind == SolidKind::tube ? "tube"
                                                : "solid";
  const std::string_view of = facts_of(plan.candidates).of_daughters;
  if (!of.empty()) text.append(", ").append(of);
  if (scene.daughters.empty()) return text;
  if (plan.candidates == Candidates::lanes) {
    text += scene.daughters.size() <= kernels::lanes_of_four ? " four" : " eight";
  }
  const bool round = plan.candidates == Candidates::nest || plan.candidates == Candidates::rings;
  const bool wires = plan.candidates == Candidates::wires;
  return text + (!round && !wires && all_boxes(scene)            ? " boxes"
                 : !round && all_of_kind(scene, SolidKind::tube) ? " tubes"
                                                                 : " solids");
}

}  // namespace navjit::codegen
