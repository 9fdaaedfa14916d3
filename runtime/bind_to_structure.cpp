#include "runtime/bind_to_structure.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "analysis/plan.hpp"
#include "cache/sha256.hpp"
#include "codegen/structure.hpp"
#include "runtime/bind_to_data.hpp"
#include "runtime/compile.hpp"
#include "runtime/compiling.hpp"
#include "runtime/gather.hpp"
#include "runtime/install.hpp"
#include "runtime/judge.hpp"
#include "runtime/log_text.hpp"
#include "runtime/make_module.hpp"

namespace navjit {
namespace {

/// The share of a data-bound step's time that is saved by code that knows the kinds of solids. A
/// guess.
constexpr double gain_over_data = 0.15;
/// Expected time to compile a structure, for each of its solids, ms. A guess from 13 structures of
/// seven detectors: those of one to three solids took 70 to 470 ms, those of dozens up to 5 s.
constexpr double solid_ms = 100;
/// Fewer steps in a scene are not worth a place in a structure.
constexpr double least_steps = 500;

/// Scenes of one structure.
struct Alike {
  std::vector<VolumeId> volumes{};
  double compile_ms = 0, spent_ns = 0;
};

/// Scenes that are bound to data by an instance that takes any solid, by the digest of their
/// structure's text. Texts are long, and there may be thousands of them.
std::map<cache::Digest, Alike> find_structures(Specialisation& spec, bool all) {
  const Geometry& geometry = spec.shared->geometry;
  std::map<cache::Digest, Alike> structures;
  for (std::size_t v = 0; v < geometry.size(); ++v) {
    const auto volume = static_cast<VolumeId>(v);
    const double executions = spec.executions(volume);
    if (!spec.facts.reachable[v] || spec.structure_tried.contains(volume)) continue;
    if (!all && (executions < least_steps || !std::isfinite(bound_ns(spec, volume)))) continue;
    const ScenePlan plan = plan_scene(geometry, spec.facts, volume);
    const double compile_ms =
        solid_ms * static_cast<double>(codegen::solids_of_structure(geometry, plan));
    const bool gains = codegen::gains_from_structure(geometry, plan);
    if (!gains || compile_ms > longest_module_ms) {
      spec.structure_tried.insert(volume);
      if (gains) {
        spec.shared->log->debug("event=structure_too_large scene={} expected_ms={:.0f}",
                                in_quotes(geometry.world().volumes[v].name), compile_ms);
      }
      continue;
    }
    auto known = spec.structures_of.find(volume);
    if (known == spec.structures_of.end()) {
      const std::string source = codegen::generate_structure(geometry, spec.facts, plan).source;
      known = spec.structures_of.emplace(volume, cache::sha256({source})).first;
    }
    Alike& alike = structures[known->second];
    alike.spent_ns += executions * (all ? 1 : bound_ns(spec, volume));
    alike.compile_ms = compile_ms;
    alike.volumes.push_back(volume);
  }
  return structures;
}

std::uint64_t all_steps(const Specialisation& spec) {
  return std::accumulate(spec.steps.begin(), spec.steps.end(), std::uint64_t{0});
}

/// The modules of its scenes, without their texts, which are all alike.
DueStructure made_of(Specialisation& spec, const Alike& alike) {
  DueStructure structure{.compile_ms = alike.compile_ms, .spent_ns = alike.spent_ns};
  const Geometry& geometry = spec.shared->geometry;
  for (const VolumeId volume : alike.volumes) {
    const ScenePlan plan = plan_scene(geometry, spec.facts, volume);
    codegen::Module module = codegen::generate_structure(geometry, spec.facts, plan);
    if (structure.source.empty()) structure.source = module.source;
    // A search that was measured since the scene was looked at may have changed the text.
    spec.structures_of.erase(volume);
    if (module.source != structure.source) continue;
    module.source = {};
    structure.scenes.push_back(std::move(module));
  }
  return structure;
}

/// Nothing if there is none, or if the time that was spent in the scenes of the best one has not
/// paid for compiling it `least` times.
std::optional<DueStructure> best_of(Specialisation& spec,
                                    const std::map<cache::Digest, Alike>& structures,
                                    double least) {
  const auto best =
      std::max_element(structures.begin(), structures.end(), [](const auto& a, const auto& b) {
        return a.second.spent_ns * b.second.compile_ms < b.second.spent_ns * a.second.compile_ms;
      });
  if (best == structures.end()) return {};
  const Alike& alike = best->second;
  const double paid =
      alike.spent_ns * gain_over_data / (spec.compile_weight() * alike.compile_ms * 1e6);
  if (paid < least) return {};
  DueStructure structure = made_of(spec, alike);
  structure.paid = paid;
  return structure;
}

bool may_compile(const Specialisation& spec) {
  return spec.shared->options.specialiser.structures && spec.maker && !spec.hopeless &&
         !spec.stopping();
}

}  // namespace

std::optional<DueStructure> due_structure(Specialisation& spec) {
  if (!may_compile(spec) || spec.group_lost || spec.allowance_is_used_up()) return {};
  // Planning all scenes takes time: if no structure paid, the next look comes after an eighth more
  // steps.
  if (all_steps(spec) < spec.structures_again_at) return {};
  std::optional<DueStructure> best = best_of(spec, find_structures(spec, false), 1);
  if (best) return best;
  spec.structures_again_at = all_steps(spec) / 8 * 9;
  return {};
}

std::optional<DueStructure> any_structure(Specialisation& spec) {
  if (!may_compile(spec)) return {};
  return best_of(spec, find_structures(spec, true), 0);
}

bool bind_to_structure(Specialisation& spec, const DueStructure& structure) {
  std::string source = structure.source;
  if (spec.shared->faults.edit_source) spec.shared->faults.edit_source(source);
  for (const codegen::Module& scene : structure.scenes) {
    spec.structure_tried.insert(scene.entries[0].volume);
  }
  show_candidates(spec);
  const double start = steady_seconds();
  if (auto found = spec.maker->find(source)) {
    if (install_structure(spec, structure.scenes, std::move(found->code), true, start)) return true;
    if (spec.stopping()) return false;
    spec.maker->reject(source);
  }
  Expected<CodeMaker::Made> made = stopped();
  {
    std::set<VolumeId> volumes;
    for (const codegen::Module& scene : structure.scenes) volumes.insert(scene.entries[0].volume);
    const Compiling compiling(spec, volumes);
    made = compile(spec, source);
  }
  if (!made) {
    if (made.failure().stopped) return false;
    count_in_vain(spec, start);
    if (nothing_more(spec, made.failure())) return false;
    spec.shared->log->warn("a structure is not compiled: {}", one_line(made.failure().message));
    return true;
  }
  const jit::CompileReport report = made->object.report;
  if (install_structure(spec, structure.scenes, std::move(made->code), false, start)) {
    spec.maker->keep(source, "a structure", made->object);
  }
  spec.shared->log->debug(
      "event=structure at_s={:.3f} scenes={} ms={:.0f} source_kb={} frontend_ms={:.0f} "
      "optimise_ms={:.0f} codegen_ms={:.0f} code_kb={}",
      spec.seconds(), structure.scenes.size(), (steady_seconds() - start) * 1e3,
      source.size() / 1024, report.frontend_ms, report.optimise_ms, report.codegen_ms,
      report.code_bytes / 1024);
  return true;
}

}  // namespace navjit
