#include "runtime/bind_to_structure.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "analysis/plan.hpp"
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

/// Scenes that are bound to data by an instance that takes any solid, by structure.
std::map<std::string, DueStructure> find_structures(Specialisation& spec, bool all) {
  const Geometry& geometry = spec.shared->geometry;
  std::map<std::string, DueStructure> structures;
  for (std::size_t v = 0; v < geometry.size(); ++v) {
    const auto volume = static_cast<VolumeId>(v);
    const double executions = spec.executions(volume);
    if (!spec.facts.reachable[v] || spec.structure_tried.contains(volume)) continue;
    if (!all && (executions < least_steps || !std::isfinite(bound_ns(spec, volume)))) continue;
    const ScenePlan plan = plan_scene(geometry, spec.facts, volume);
    if (!codegen::gains_from_structure(geometry, plan)) {
      spec.structure_tried.insert(volume);
      continue;
    }
    codegen::Module module = codegen::generate_structure(geometry, spec.facts, plan);
    DueStructure& structure = structures[module.source];
    structure.spent_ns += executions * (all ? 1 : bound_ns(spec, volume));
    structure.compile_ms =
        solid_ms * static_cast<double>(codegen::solids_of_structure(geometry, plan));
    structure.scenes.push_back(std::move(module));
  }
  return structures;
}

std::uint64_t all_steps(const Specialisation& spec) {
  return std::accumulate(spec.steps.begin(), spec.steps.end(), std::uint64_t{0});
}

std::optional<DueStructure> best_of(std::map<std::string, DueStructure> structures) {
  const auto best =
      std::max_element(structures.begin(), structures.end(), [](const auto& a, const auto& b) {
        return a.second.spent_ns * b.second.compile_ms < b.second.spent_ns * a.second.compile_ms;
      });
  if (best == structures.end()) return {};
  best->second.source = best->first;
  return std::move(best->second);
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
  std::optional<DueStructure> best = best_of(find_structures(spec, false));
  if (best) {
    best->paid = best->spent_ns * gain_over_data / (spec.compile_weight() * best->compile_ms * 1e6);
    if (best->paid >= 1) return best;
  }
  spec.structures_again_at = all_steps(spec) / 8 * 9;
  return {};
}

std::optional<DueStructure> any_structure(Specialisation& spec) {
  if (!may_compile(spec)) return {};
  return best_of(find_structures(spec, true));
}

bool bind_to_structure(Specialisation& spec, const DueStructure& structure) {
  const std::string& source = structure.source;
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
    if (made.failure().stopped || nothing_more(spec, made.failure())) return false;
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
