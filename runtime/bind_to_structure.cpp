#include "runtime/bind_to_structure.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "analysis/plan.hpp"
#include "codegen/structure.hpp"
#include "runtime/bind_to_data.hpp"
#include "runtime/compiling.hpp"
#include "runtime/gather.hpp"
#include "runtime/install.hpp"
#include "runtime/judge.hpp"
#include "runtime/log_text.hpp"
#include "runtime/make_module.hpp"

namespace navjit {
namespace {

/// Of a data-bound step, what code wins that knows the kinds of solids. A guess.
constexpr double gain_over_data = 0.15;
/// What a structure costs to compile, for each of its solids, ms. A guess from 13 structures of
/// seven detectors: of one to three solids they took 70 to 470 ms, of dozens up to 5 s.
constexpr double solid_ms = 100;
/// Fewer steps in a scene are not worth a place in a structure.
constexpr double least_steps = 500;

struct Structure {
  std::vector<codegen::Module> scenes{};
  double compile_ms = 0;  ///< expected
  double spent_ns = 0;    ///< steps and relocations in them, by the time of a step
};

/// Scenes that are bound to data by an instance that takes any solid, by structure.
std::map<std::string, Structure> find_structures(Specialisation& spec, bool all) {
  const Geometry& geometry = spec.shared->geometry;
  std::map<std::string, Structure> structures;
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
    Structure& structure = structures[module.source];
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

}  // namespace

bool bind_to_structure(Specialisation& spec, bool all) {
  const SpecialiserOptions& options = spec.shared->options.specialiser;
  if (!options.structures || !spec.maker || spec.hopeless || spec.stopping()) return false;
  if (!all && (spec.group_lost || spec.allowance_is_used_up())) return false;
  // Plans take their time: where none paid, it looks again after a few more steps.
  if (!all && all_steps(spec) < spec.structures_again_at) return false;
  std::map<std::string, Structure> structures = find_structures(spec, all);
  const auto best =
      std::max_element(structures.begin(), structures.end(), [](const auto& a, const auto& b) {
        return a.second.spent_ns * b.second.compile_ms < b.second.spent_ns * a.second.compile_ms;
      });
  const auto pays = [&](const Structure& structure) {
    return structure.spent_ns * gain_over_data >=
           spec.compile_weight() * structure.compile_ms * 1e6;
  };
  if (best == structures.end() || !(all || pays(best->second))) {
    spec.structures_again_at = all_steps(spec) / 8 * 9;
    return false;
  }
  const auto& [source, structure] = *best;
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
    return false;
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
