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

/// Plans made once each: several hot scenes have the same neighbours.
class Plans {
 public:
  Plans(const Geometry& geometry, const WorldFacts& facts) : geometry_(geometry), facts_(facts) {}

  const ScenePlan& of(VolumeId volume) {
    const auto known = plans_.find(volume);
    if (known != plans_.end()) return known->second;
    return plans_.emplace(volume, plan_scene(geometry_, facts_, volume)).first->second;
  }

 private:
  const Geometry& geometry_;
  const WorldFacts& facts_;
  std::map<VolumeId, ScenePlan> plans_;
};

std::map<VolumeId, Parts> choose_parts(const Geometry& geometry, const WorldFacts& facts,
                                       std::span<const VolumeId> hot, Plans& plans) {
  std::map<VolumeId, Parts> parts;
  for (const VolumeId v : hot) {
    const bool has_daughters = !geometry.scene(v).daughters.empty();
    // Of volumes with equal structure the first stands for all.
    parts[facts.first_equal[v]] = {true, has_daughters, has_daughters};
  }
  std::size_t neighbours = 0;
  const auto add = [&](VolumeId volume, bool Parts::*part) {
    const VolumeId first = facts.first_equal[volume];
    const auto known = parts.find(first);
    if (known != parts.end()) {
      known->second.*part = true;
    } else if (neighbours < most_neighbours && worth_compiling(geometry, plans.of(first))) {
      parts[first].*part = true;
      ++neighbours;
    }
  };
  for (const VolumeId v : hot) {
    // Where a track goes from a hot scene: out into the mother, and down into daughters.
    if (const auto mother = facts.only_mothers[v]) add(*mother, &Parts::reenter);
    VolumeId last = v;  // placements of one volume mostly follow each other
    for (const Daughter& d : geometry.scene(v).daughters) {
      if (d.volume == last || geometry.scene(d.volume).daughters.empty()) continue;
      add(d.volume, &Parts::enter);
      last = d.volume;
    }
  }
  return parts;
}

}  // namespace

Module generate(const Geometry& geometry, const WorldFacts& facts, std::span<const VolumeId> hot) {
  Plans plans(geometry, facts);
  const std::map<VolumeId, Parts> parts = choose_parts(geometry, facts, hot, plans);
  Shapes shapes;
  Neighbours neighbours;
  for (const auto& [volume, part] : parts) {
    if (part.enter) neighbours.enter.insert(volume);
    if (part.reenter) neighbours.reenter.insert(volume);
  }
  std::string declarations, bodies;
  Module module;
  for (const auto& [volume, part] : parts) {
    const ScenePlan& plan = plans.of(volume);
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
      const std::string relocate = "navjit_relocate_" + id + "_" + identifier(name);
      bodies += text.step(step) + text.relocate(relocate);
      std::string safety;
      if (plan.safety != SafetyFrom::generic) {
        safety = "navjit_safety_" + id + "_" + identifier(name);
        bodies += text.safety(safety);
      }
      for (const VolumeId equal : facts.equals[volume]) {
        module.entries.push_back({equal, step, relocate, safety});
      }
    }
  }
  std::string& source = module.source;
  source += "// Navigators for ";
  source += std::to_string(hot.size()) + " scenes. Generated: do not edit.\n";
  const std::string push =
      "#pragma clang attribute push(__attribute__((always_inline)), apply_to = function)\n";
  const std::string pop = "#pragma clang attribute pop\n";
  source += push;
  for (const char* head : {"vectors", "prelude"}) source += kernel_text(head);
  source += pop;
  for (const char* kernel : kernel_order()) {
    if (!shapes.kernels().contains(kernel)) continue;
    // Constants fold only into kernels that are inlined; the large ones would be inlined into each
    // other again and again.
    const bool small = inlines_everywhere(kernel);
    source += (small ? push : "") + std::string(kernel_text(kernel)) + (small ? pop : "");
  }
  source += push;
  source += kernel_text("grid");
  source += kernel_text("boxes");
  source += kernel_text("slabs");
  if (shapes.kernels().contains("box")) source += kernel_text("four_boxes");
  source += kernel_text("nest");
  source += kernel_text("rings");
  source += kernel_text("navigation_stack");
  source += kernel_text("navigation");
  source += "#pragma clang attribute pop\n\nnamespace navjit::kernels {\n\n";
  source += "constexpr double tolerance = " + number(geometry.tolerance()) + ";\n";
  source += shapes.definitions() + declarations + bodies;
  source += "\n}  // namespace navjit::kernels\n";
  return module;
}

}  // namespace navjit::codegen
