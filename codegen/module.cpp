#include "codegen/module.hpp"

#include <map>
#include <set>

#include "codegen/kernel_names.hpp"
#include "codegen/kernel_texts.hpp"
#include "codegen/scene_text.hpp"
#include "codegen/shapes.hpp"
#include "codegen/text.hpp"

namespace navjit::codegen {
namespace {

/// Which functions a module has of each volume.
struct Parts {
  bool step = false;     ///< hot: step and both relocations, exported
  bool enter = false;    ///< downward relocation
  bool reenter = false;  ///< relocation out of a daughter
};

/// Relocation of more scenes than this beside the hot ones is left to the table.
constexpr std::size_t most_neighbours = 24;

std::map<VolumeId, Parts> choose_parts(const Geometry& geometry, const WorldFacts& facts,
                                       std::span<const VolumeId> hot) {
  std::map<VolumeId, Parts> parts;
  // Of volumes with equal structure the first stands for all.
  const auto first = [&](VolumeId v) { return facts.first_equal[v]; };
  const auto worth = [&](VolumeId v) {
    return worth_compiling(geometry, plan_scene(geometry, facts, first(v)));
  };
  for (const VolumeId v : hot) {
    const bool has_daughters = !geometry.scene(v).daughters.empty();
    parts[first(v)] = {true, has_daughters, has_daughters};
  }
  std::size_t neighbours = 0;
  for (const VolumeId v : hot) {
    // Where a track goes from a hot scene: out into the mother, and from there into a sister.
    if (const auto mother = facts.only_mothers[v];
        mother && neighbours < most_neighbours && worth(*mother)) {
      neighbours += parts.contains(first(*mother)) ? 0 : 1;
      parts[first(*mother)].reenter = true;
    }
    for (const Daughter& d : geometry.scene(v).daughters) {
      if (neighbours >= most_neighbours) break;
      if (geometry.scene(d.volume).daughters.empty() || parts[first(d.volume)].enter) continue;
      if (!worth(d.volume)) continue;
      neighbours += parts.contains(first(d.volume)) ? 0 : 1;
      parts[first(d.volume)].enter = true;
    }
  }
  return parts;
}

}  // namespace

Module generate(const Geometry& geometry, const WorldFacts& facts, std::span<const VolumeId> hot) {
  const std::map<VolumeId, Parts> parts = choose_parts(geometry, facts, hot);
  Shapes shapes;
  Neighbours neighbours;
  for (const auto& [volume, part] : parts) {
    if (part.enter) neighbours.enter.insert(volume);
    if (part.reenter) neighbours.reenter.insert(volume);
  }
  std::string declarations, bodies;
  Module module;
  for (const auto& [volume, part] : parts) {
    const ScenePlan plan = plan_scene(geometry, facts, volume);
    const SceneText text{geometry, facts, plan, neighbours, shapes};
    const std::string id = std::to_string(volume);
    const std::string& name = geometry.world().volumes[volume].name;
    bodies += "\n// --- " + identifier(name) + ": " + identifier(plan.pattern) + "\n\n";
    if (part.enter) declarations += text.enter_declaration();
    if (part.reenter) declarations += text.reenter_declaration();
    if (part.step || part.enter || part.reenter) bodies += text.search();
    if (part.enter) bodies += text.enter();
    if (part.reenter) bodies += text.reenter();
    if (part.step) {
      const std::string step = "navjit_step_" + id + "_" + identifier(name);
      const std::string settle = "navjit_settle_" + id + "_" + identifier(name);
      bodies += text.step(step) + text.settle(settle);
      for (const VolumeId equal : facts.equals[volume]) {
        module.entries.push_back({equal, step, settle});
      }
    }
  }
  std::string& source = module.source;
  source += "// Navigators for ";
  source += std::to_string(hot.size()) + " scenes. Generated: do not edit.\n";
  const std::string push =
      "#pragma clang attribute push(__attribute__((always_inline)), apply_to = function)\n";
  const std::string pop = "#pragma clang attribute pop\n";
  source += push + std::string(kernel_text("prelude")) + pop;
  for (const char* kernel : kernel_order()) {
    if (!shapes.kernels().contains(kernel)) continue;
    // Constants fold only into kernels that are inlined; the large ones would be inlined into each
    // other again and again.
    const bool small = inlines_everywhere(kernel);
    source += (small ? push : "") + std::string(kernel_text(kernel)) + (small ? pop : "");
  }
  source += push;
  source += kernel_text("buckets");
  source += kernel_text("navigation");
  source += "#pragma clang attribute pop\n\nnamespace navjit::kernels {\n\n";
  source += "constexpr double tolerance = " + number(geometry.tolerance()) + ";\n";
  source += shapes.definitions() + declarations + bodies;
  source += "\n}  // namespace navjit::kernels\n";
  return module;
}

}  // namespace navjit::codegen
