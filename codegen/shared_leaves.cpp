#include "codegen/shared_leaves.hpp"

#include <map>
#include <string>

namespace navjit::codegen {

bool may_share_code(const Scene& scene) {
  return scene.daughters.empty() &&
         (scene.solid.kind == SolidKind::box || scene.solid.kind == SolidKind::tube);
}

std::vector<std::vector<VolumeId>> leaves_that_share(const Geometry& geometry,
                                                     const WorldFacts& facts,
                                                     std::span<const ScenePlan* const> leaves,
                                                     const Neighbours& neighbours) {
  std::vector<std::vector<VolumeId>> groups;
  std::map<std::string, std::size_t> known;
  for (const ScenePlan* plan : leaves) {
    Arena arena;
    Shapes shapes;
    const SceneParts parts = parts_of_scene(geometry, *plan, Numbers::own_solid, shapes);
    const SceneTables tables =
        make_tables({geometry, *plan, geometry.scene(plan->volume), arena}, parts);
    const std::string has_safety = plan->safety == SafetyFrom::generic ? "" : "and a safety";
    const std::string code =
        scene_types(geometry, facts, *plan, parts, tables, neighbours, 0, "leaf", shapes);
    const auto [at, fresh] = known.try_emplace(code + has_safety, groups.size());
    if (fresh) groups.emplace_back();
    groups[at->second].push_back(plan->volume);
  }
  std::erase_if(groups, [](const auto& group) { return group.size() < 2; });
  return groups;
}

}  // namespace navjit::codegen
