#include "codegen/module.hpp"

#include <cstring>
#include <map>

#include "codegen/module_text.hpp"
#include "codegen/scene_types.hpp"
#include "codegen/shared_leaves.hpp"
#include "codegen/text.hpp"
#include "codegen/typed_solid.hpp"
#include "geometry/navigation/scene.hpp"

namespace navjit::codegen {
namespace {

/// Which functions a module has for a volume.
struct Parts {
  bool step = false;     ///< for hot volumes: step and both relocations, exported
  bool enter = false;    ///< downward relocation
  bool reenter = false;  ///< relocation out of a daughter
};

/// At most this many scenes besides the hot ones have their relocation in the module. The others
/// are relocated in through the dispatch table.
constexpr std::size_t most_neighbours = 24;
/// Scenes with more different solids (solids_of) than this are not among them. All these solids
/// would be inlined, which takes longer to compile than the hot scenes themselves.
constexpr std::size_t most_solids = 8;

/// Plans, each made once, since several hot scenes have the same neighbours. The first of equal
/// volumes is planned for all of them.
class Plans {
 public:
  Plans(const Geometry& geometry, const WorldFacts& facts) : geometry_(geometry), facts_(facts) {}

  const ScenePlan& of(VolumeId volume) {
    const auto known = plans_.find(volume);
    if (known != plans_.end()) return known->second;
    ScenePlan plan = plan_scene(geometry_, facts_, volume);
    plan.frame = facts_.of_equals[volume].frame;
    plan.only_mother = facts_.of_equals[volume].only_mother;
    return plans_.emplace(volume, std::move(plan)).first->second;
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
    // The first of equal volumes stands for all of them.
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
    // The scenes to which a track goes from a hot scene: the mother, and daughters.
    const VolumeId first = facts.first_equal[v];
    if (const auto mother = facts.of_equals[first].mothers) add(*mother, &Parts::reenter);
    VolumeId last = v;  // placements of one volume mostly follow one another
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

/// The tables of a module's scenes, one after the other.
class ModuleData {
 public:
  /// Adds a scene's tables; returns their offset.
  std::size_t add(const SceneTables& tables) {
    const std::size_t at = begin(tables.bytes);
    std::memcpy(bytes_.data() + at, tables.data, tables.bytes);
    return at;
  }
  /// The same for a leaf that shares code. Its tables lie behind a SharedLeafData, whose offset is
  /// returned.
  std::size_t add_shared(const SceneTables& tables) {
    const std::size_t at = begin(sizeof(kernels::SharedLeafData) + tables.bytes);
    std::memcpy(bytes_.data() + at + sizeof(kernels::SharedLeafData), tables.data, tables.bytes);
    shared_.push_back(at);
    return at;
  }
  /// Puts all tables into the arena.
  const void* place(Arena& arena) const {
    auto* lines =
        arena.array<TableLine>((bytes_.size() + sizeof(TableLine) - 1) / sizeof(TableLine));
    if (!bytes_.empty()) std::memcpy(lines, bytes_.data(), bytes_.size());
    const kernels::SharedLeafData header{lines};
    for (const std::size_t at : shared_) {
      std::memcpy(reinterpret_cast<std::byte*>(lines) + at, &header, sizeof header);
    }
    return lines;
  }

 private:
  std::size_t begin(std::size_t bytes) {
    const std::size_t at =
        (bytes_.size() + table_alignment - 1) / table_alignment * table_alignment;
    bytes_.resize(at + bytes);
    return at;
  }

  std::vector<std::byte> bytes_;
  std::vector<std::size_t> shared_;
};

/// For each leaf that shares code, the first leaf of its group.
std::map<VolumeId, VolumeId> find_shared(const Geometry& geometry, const WorldFacts& facts,
                                         const std::map<VolumeId, Parts>& parts, Plans& plans,
                                         const Neighbours& neighbours) {
  std::vector<const ScenePlan*> leaves;
  for (const auto& [volume, part] : parts) {
    if (part.step && may_share_code(geometry.scene(volume))) leaves.push_back(&plans.of(volume));
  }
  std::map<VolumeId, VolumeId> first;
  for (const auto& group : leaves_that_share(geometry, facts, leaves, neighbours)) {
    for (const VolumeId volume : group) first[volume] = group[0];
  }
  return first;
}

}  // namespace

std::size_t solids_of(const Geometry& geometry, const ScenePlan& plan) {
  std::size_t solids = solids_in(geometry.scene(plan.volume).solid);
  for (const DaughterClass& c : plan.classes) solids += solids_in(c.shapes[0].solid);
  return solids;
}

Module generate(const Geometry& geometry, const WorldFacts& facts, std::span<const VolumeId> hot,
                Leaves leaves) {
  Plans plans(geometry, facts);
  const std::map<VolumeId, Parts> parts = choose_parts(geometry, facts, hot, plans);
  Neighbours neighbours;
  for (const auto& [volume, part] : parts) {
    if (part.enter) neighbours.enter.insert(volume);
    if (part.reenter) neighbours.reenter.insert(volume);
  }
  std::map<VolumeId, VolumeId> shared;
  if (leaves == Leaves::shared) shared = find_shared(geometry, facts, parts, plans, neighbours);
  Module module;
  const auto arena = std::make_shared<Arena>();
  ModuleData data;
  Shapes shapes;
  std::string declarations, types, functions;
  for (const auto& [volume, part] : parts) {
    const ScenePlan& plan = plans.of(volume);
    const auto sharing = shared.find(volume);
    const bool shares = sharing != shared.end();
    const VolumeId written = shares ? sharing->second : volume;
    const SceneParts scene =
        parts_of_scene(geometry, plan, shares ? Numbers::own_solid : Numbers::constants, shapes);
    const bool stand_ins = facts.of_equals[volume].stand_ins;
    const SceneTables tables = make_tables({geometry, plan, geometry.scene(volume), *arena, nullptr,
                                            stand_ins ? &facts.first_equal : nullptr},
                                           scene);
    const std::size_t at = shares ? data.add_shared(tables) : data.add(tables);
    const std::string name = scene_name(written);
    const std::string label = identifier(geometry.world().volumes[written].name);
    if (written == volume) {
      declarations += "struct " + name + ";\n";
      types += "\n// --- " + label + ": " + identifier(plan.pattern) + "\n\n" +
               scene_types(geometry, facts, plan, scene, tables, neighbours,
                           shares ? sizeof(kernels::SharedLeafData) : at, name, shapes);
    }
    if (!part.step) continue;
    const std::string suffix = std::to_string(written) + "_" + label;
    Entry entry{volume, "navjit_step_" + suffix, "navjit_relocate_" + suffix,
                plan.safety == SafetyFrom::generic ? "" : "navjit_safety_" + suffix,
                shares ? at : 0};
    if (written == volume) functions += entry_functions(entry, name);
    for (const VolumeId equal : facts.equals[volume]) {
      entry.volume = equal;
      module.entries.push_back(entry);
    }
  }
  module.data = data.place(*arena);
  module.owner = arena;
  module.source = module_text("Navigators for " + std::to_string(hot.size()) + " scenes.", shapes,
                              "using Tolerance = ConstantNumber<" + number(geometry.tolerance()) +
                                  ">;\n" + shapes.definitions() + declarations + types,
                              functions);
  return module;
}

}  // namespace navjit::codegen
