#include "codegen/module.hpp"

#include <cstring>
#include <map>

#include "codegen/module_text.hpp"
#include "codegen/scene_types.hpp"
#include "codegen/text.hpp"
#include "codegen/typed_solid.hpp"

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
/// And so is that of scenes of more different solids (solids_of): all of them would be inlined,
/// which takes longer to compile than the hot scenes themselves.
constexpr std::size_t most_solids = 8;

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
    } else if (neighbours < most_neighbours && worth_compiling(geometry, plans.of(first)) &&
               solids_of(geometry, plans.of(first)) <= most_solids) {
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

constexpr std::size_t table_alignment = 64;
struct alignas(table_alignment) TableLine {
  std::byte bytes[table_alignment];
};

}  // namespace

std::size_t solids_of(const Geometry& geometry, const ScenePlan& plan) {
  std::size_t solids = solids_in(geometry.scene(plan.volume).solid);
  for (const DaughterClass& c : plan.classes) solids += solids_in(c.shapes[0].solid);
  return solids;
}

Module generate(const Geometry& geometry, const WorldFacts& facts, std::span<const VolumeId> hot) {
  Plans plans(geometry, facts);
  const std::map<VolumeId, Parts> parts = choose_parts(geometry, facts, hot, plans);
  Neighbours neighbours;
  for (const auto& [volume, part] : parts) {
    if (part.enter) neighbours.enter.insert(volume);
    if (part.reenter) neighbours.reenter.insert(volume);
  }
  Module module;
  const auto arena = std::make_shared<Arena>();
  std::vector<std::byte> data;
  Shapes shapes;
  std::string declarations, types, functions;
  for (const auto& [volume, part] : parts) {
    const ScenePlan& plan = plans.of(volume);
    const SceneParts scene = parts_of_scene(geometry, plan, Numbers::constants, shapes);
    const SceneTables tables = make_tables({geometry, plan, geometry.scene(volume), *arena}, scene);
    const std::size_t at = (data.size() + table_alignment - 1) / table_alignment * table_alignment;
    data.resize(at + tables.bytes);
    std::memcpy(data.data() + at, tables.data, tables.bytes);
    const std::string name = scene_name(volume);
    const std::string label = identifier(geometry.world().volumes[volume].name);
    declarations += "struct " + name + ";\n";
    types += "\n// --- " + label + ": " + identifier(plan.pattern) + "\n\n" +
             scene_types(geometry, facts, plan, scene, tables, neighbours, at, name, shapes);
    if (!part.step) continue;
    const std::string suffix = std::to_string(volume) + "_" + label;
    Entry entry{volume, "navjit_step_" + suffix, "navjit_relocate_" + suffix,
                plan.safety == SafetyFrom::generic ? "" : "navjit_safety_" + suffix};
    functions += entry_functions(entry, name);
    for (const VolumeId equal : facts.equals[volume]) {
      entry.volume = equal;
      module.entries.push_back(entry);
    }
  }
  auto* place = arena->array<TableLine>((data.size() + sizeof(TableLine) - 1) / sizeof(TableLine));
  if (!data.empty()) std::memcpy(place, data.data(), data.size());
  module.data = place;
  module.owner = arena;
  module.source = module_text("Navigators for " + std::to_string(hot.size()) + " scenes.", shapes,
                              "using Tolerance = ConstantNumber<" + number(geometry.tolerance()) +
                                  ">;\n" + shapes.definitions() + declarations + types,
                              functions);
  return module;
}

}  // namespace navjit::codegen
