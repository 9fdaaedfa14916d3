#include "codegen/structure.hpp"

#include <algorithm>

#include "analysis/foreign.hpp"
#include "codegen/data/instances.hpp"
#include "codegen/module_text.hpp"
#include "codegen/scene_types.hpp"
#include "codegen/typed_solid.hpp"

namespace navjit::codegen {
namespace {

/// Each type of daughters' solids is a branch and code of its own. If there are more types than
/// this, the library's switch over kinds is as good. A guess.
constexpr std::size_t most_types = 16;

bool is_known_to_library(SolidKind kind) {
  return kind == SolidKind::box || kind == SolidKind::tube;
}

}  // namespace

bool gains_from_structure(const Geometry& geometry, const ScenePlan& plan) {
  if (facts_of(plan.candidates).for_data_alone) return false;
  const Scene& scene = geometry.scene(plan.volume);
  if (scene.solid.kind == SolidKind::facets || holds_foreign(scene)) return false;
  if (!is_known_to_library(scene.solid.kind)) return true;
  if (scene.daughters.empty() || all_boxes(scene) || all_of_kind(scene, SolidKind::tube)) {
    return false;
  }
  Shapes shapes;
  return parts_of_scene(geometry, plan, Numbers::tables, shapes).classes.size() <= most_types;
}

std::size_t solids_of_structure(const Geometry& geometry, const ScenePlan& plan) {
  const Scene& scene = geometry.scene(plan.volume);
  Shapes shapes;
  std::size_t solids = solids_in(scene.solid);
  for (const PartClass& c : parts_of_scene(geometry, plan, Numbers::tables, shapes).classes) {
    solids += solids_in(scene.daughters[c.members[0]].solid);
  }
  return solids;
}

Module generate_structure(const Geometry& geometry, const WorldFacts& facts,
                          const ScenePlan& plan) {
  Shapes shapes;
  const SceneParts parts = parts_of_scene(geometry, plan, Numbers::tables, shapes);
  const auto arena = std::make_shared<Arena>();
  const SceneTables tables =
      make_tables({geometry, plan, geometry.scene(plan.volume), *arena}, parts);
  const std::string name = "scene";
  const std::string types =
      scene_types(geometry, facts, plan, parts, tables, Neighbours{}, 0, name, shapes);
  const Entry entry{plan.volume, "navjit_step_structure", "navjit_relocate_structure",
                    plan.safety == SafetyFrom::generic ? "" : "navjit_safety_structure"};
  Module module;
  module.entries.push_back(entry);
  module.data = tables.data;
  module.owner = arena;
  module.source = module_text("A navigator for all scenes of a structure.", shapes, types,
                              entry_functions(entry, name));
  return module;
}

}  // namespace navjit::codegen
