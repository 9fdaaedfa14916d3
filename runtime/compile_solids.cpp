#include "runtime/compile_solids.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <optional>

#include "codegen/solids.hpp"
#include "runtime/bind_to_data.hpp"
#include "runtime/compile.hpp"
#include "runtime/compiling.hpp"
#include "runtime/install.hpp"
#include "runtime/judge.hpp"
#include "runtime/log_text.hpp"
#include "runtime/make_module.hpp"
#include "runtime/processor_time.hpp"
#include "runtime/verify_solid.hpp"

namespace navjit {
namespace {

/// The share of the time spent in a solid that code for it saves.
constexpr double gain_of_code = 0.5;
/// The same for a solid for which the library has code. Constants make this a twentieth faster
/// (docs/experiments.md).
constexpr double gain_over_library = 0.05;
/// The largest expected time for a module, unless a single solid takes longer. Modules are small
/// because a module costs little besides its solids, and the first solids need not wait for the
/// last.
constexpr double most_solids_ms = 250;
/// Assumed time of a step in a scene that holds such solids, ns, if none was timed yet. A guess.
constexpr double usual_ns = 100;
/// Solids that have paid this share of their compile time are compiled together with one that is
/// due.
constexpr double soon = 0.3;
constexpr int points_made_up = 400;  ///< per solid, for verification

/// The code of a module's solids, and the records through which scenes call it.
struct Installed {
  jit::Code code;
  std::shared_ptr<const codegen::Arena> numbers;
  std::vector<kernels::SolidCode> solids;
};

bool is_compiled(const Specialisation& spec, VolumeId volume) {
  const std::lock_guard lock(spec.mutex);
  const auto known = spec.scenes.find(volume);
  return known != spec.scenes.end() && known->second.binding == Binding::constants;
}

bool may_be_bound(const Specialisation& spec, VolumeId volume) {
  return !is_compiled(spec, volume) && !spec.off.contains(volume);
}

/// Time spent in the scenes of the run so far, ns, by volume; 0 if the scene would not call code
/// for solids.
std::vector<double> spent_in_scenes(const Specialisation& spec) {
  std::vector<double> spent(spec.steps.size());
  for (std::size_t v = 0; v < spent.size(); ++v) {
    spent[v] = usual_ns * spec.executions(static_cast<VolumeId>(v));
  }
  const std::lock_guard lock(spec.mutex);
  for (const auto& [volume, scene] : spec.scenes) {
    if (scene.binding == Binding::constants) {
      spent[volume] = 0;
    } else if (scene.binding != Binding::generic && scene.specialised_ns_per_step > 0) {
      spent[volume] = scene.specialised_ns_per_step * spec.executions(volume);
    }
  }
  return spent;
}

/// The share of the time spent in this solid that compiling it would save.
double gain_of_code_for(const ComposedSolid& solid) {
  return solid.in_library ? gain_over_library : gain_of_code;
}

struct Wanted {
  ComposedSolid* solid;
  double urgency;  ///< how many times it has paid for itself; before a run, how often it occurs
};

/// The solids of the next module, the most urgent first. With a cache each solid has a module of
/// its own, which other runs find there whatever else is hot in them.
std::vector<ComposedSolid*> most_urgent(Specialisation& spec, std::vector<Wanted> wanted,
                                        double most_ms, double least = 0) {
  std::stable_sort(wanted.begin(), wanted.end(),
                   [](const Wanted& a, const Wanted& b) { return a.urgency > b.urgency; });
  const std::size_t most = spec.maker->has_cache() ? 1 : wanted.size();
  std::vector<ComposedSolid*> chosen;
  double expected = module_base_ms;
  for (const Wanted& c : wanted) {
    if (chosen.size() == most) break;
    if (!chosen.empty() && (expected + c.solid->compile_ms > most_ms || c.urgency < least)) {
      continue;
    }
    expected += c.solid->compile_ms;
    chosen.push_back(c.solid);
  }
  return chosen;
}

/// Solids that are due, and those that soon will be; none unless at least one is due.
std::vector<Wanted> due_solids(Specialisation& spec) {
  const double weight = spec.compile_weight();
  const std::vector<double> spent = spent_in_scenes(spec);
  std::vector<Wanted> wanted;
  bool any_due = false;
  for (ComposedSolid& solid : *spec.composed_solids) {
    if (solid.tried) continue;
    double spent_in_it = 0;
    for (const auto& [volume, share] : solid.scenes) spent_in_it += share * spent[volume];
    const double won = gain_of_code_for(solid) * spent_in_it;
    const double paid = won / (weight * solid.compile_ms * 1e6);
    if (won == 0 || paid < soon) continue;
    any_due = any_due || paid >= 1;
    wanted.push_back({&solid, paid});
  }
  if (!any_due) wanted.clear();
  return wanted;
}

/// The solid's functions; nothing if one is missing.
std::optional<kernels::SolidCode> find_functions(const jit::Code& code,
                                                 const kernels::AnySolid<double>& solid,
                                                 const codegen::SolidEntry& entry) {
  kernels::SolidCode found{};
  found.solid = solid;
  bool whole = true;
  const auto get = [&]<class Function>(Function*& function, const std::string& name) {
    if (name.empty()) return;
    const auto address = code.function<Function>(name);
    whole = whole && address;
    function = address ? *address : nullptr;
  };
  get(found.contains, entry.contains);
  get(found.distance_to_in, entry.distance_to_in);
  get(found.distance_to_out, entry.distance_to_out);
  get(found.safety_to_in, entry.safety_to_in);
  get(found.safety_to_out, entry.safety_to_out);
  found.data = entry.data;
  return whole ? std::optional(found) : std::nullopt;
}

/// Verifies all solids of a module, and lets their scenes be bound again. Returns false, and
/// changes nothing, if one is wrong or the run has ended.
bool install_solids(Specialisation& spec, const std::vector<ComposedSolid*>& solids,
                    const codegen::SolidModule& module, jit::Code code) {
  auto installed = std::make_shared<Installed>(Installed{std::move(code), module.owner, {}});
  installed->solids.reserve(solids.size());  // pointers to them are kept
  for (std::size_t i = 0; i < solids.size(); ++i) {
    if (spec.stopping()) return false;
    const auto functions = find_functions(installed->code, solids[i]->solid, module.entries[i]);
    std::string problem = "a generated function is missing";
    if (functions) {
      problem = verify_solid(solids[i]->solid, *functions, solids[i]->extent,
                             spec.shared->geometry.tolerance(), points_made_up, i + 1);
    }
    if (spec.shared->faults.fail_verification) problem = injected_failure;
    if (!problem.empty()) {
      spec.shared->log->warn("code for a solid is wrong and is not used: {}", one_line(problem));
      return false;
    }
    installed->solids.push_back(*functions);
  }
  spec.shared->table.keep(installed);
  for (std::size_t i = 0; i < solids.size(); ++i) {
    for (const void* shape : solids[i]->shapes) {
      spec.code_of_solids[shape] = &installed->solids[i];
    }
    for (const auto& [volume, share] : solids[i]->scenes) {
      if (may_be_bound(spec, volume)) spec.bound.erase(volume);
    }
  }
  return true;
}

/// Returns false if the run has ended, or if nothing can be compiled any more.
bool make(Specialisation& spec, const std::vector<ComposedSolid*>& solids) {
  for (ComposedSolid* solid : solids) solid->tried = true;
  show_candidates(spec);
  const double start = steady_seconds(), own_start = spec.own_seconds();
  std::vector<kernels::AnySolid<double>> shapes;
  std::set<VolumeId> volumes;
  double expected = module_base_ms;
  for (const ComposedSolid* solid : solids) {
    shapes.push_back(solid->solid);
    expected += solid->compile_ms;
    for (const auto& [volume, share] : solid->scenes) {
      if (spec.executions(volume) > 0 && may_be_bound(spec, volume)) volumes.insert(volume);
    }
  }
  codegen::SolidModule module =
      codegen::generate_solids(shapes, spec.shared->geometry.tolerance(), spec.facts.with_safety);
  if (spec.shared->faults.edit_source) spec.shared->faults.edit_source(module.source);
  if (auto found = spec.maker->find(module.source)) {
    const std::size_t bytes = found->code.report().code_bytes;
    if (install_solids(spec, solids, module, std::move(found->code))) {
      count_module(spec, true, bytes, start);
      return true;
    }
    if (spec.stopping()) return false;
    spec.maker->reject(module.source);
  }
  Expected<CodeMaker::Made> made = stopped();
  {
    const Compiling compiling(spec, volumes);
    made = compile(spec, module.source);
  }
  if (!made) {
    if (made.failure().stopped) return false;
    count_in_vain(spec, start);
    if (nothing_more(spec, made.failure())) return false;
    spec.shared->log->warn("solids are not compiled: {}", one_line(made.failure().message));
    return true;
  }
  spec.expected_ms += expected;
  spec.compiled_ms += (spec.own_seconds() - own_start) * 1e3;
  const jit::CompileReport report = made->object.report;
  if (install_solids(spec, solids, module, std::move(made->code))) {
    spec.maker->keep(module.source, solids.size() == 1 ? "a solid" : "solids", made->object);
  }
  count_module(spec, false, report.code_bytes, start);
  spec.shared->log->debug(
      "event=solids at_s={:.3f} solids={} ms={:.0f} expected_ms={:.0f} source_kb={} "
      "frontend_ms={:.0f} optimise_ms={:.0f} codegen_ms={:.0f} code_kb={}",
      spec.seconds(), solids.size(), (steady_seconds() - start) * 1e3, expected,
      module.source.size() / 1024, report.frontend_ms, report.optimise_ms, report.codegen_ms,
      report.code_bytes / 1024);
  return true;
}

/// Whether solids may be compiled. Finds all composed solids of the detector on the first call.
bool may_compile(Specialisation& spec) {
  if (!spec.shared->options.specialiser.solids || !spec.maker || spec.hopeless || spec.stopping()) {
    return false;
  }
  if (!spec.composed_solids) {
    spec.composed_solids = find_composed_solids(spec.shared->geometry, spec.facts);
  }
  return true;
}

}  // namespace

double solids_paid(Specialisation& spec) {
  if (spec.group_lost || spec.allowance_is_used_up() || !may_compile(spec)) return 0;
  double most = 0;
  for (const Wanted& wanted : due_solids(spec)) most = std::max(most, wanted.urgency);
  return most;
}

bool compile_solids(Specialisation& spec, double least) {
  const double most_ms =
      std::min(most_module_ms(spec.seconds(), spec.shared->options.specialiser), most_solids_ms) /
      spec.slower_than_expected();
  // The solids are searched again, because time has passed since solids_paid() was called.
  const std::vector<ComposedSolid*> solids = most_urgent(spec, due_solids(spec), most_ms, least);
  return !solids.empty() && make(spec, solids);
}

void compile_solids_of_all(Specialisation& spec, const std::set<VolumeId>& but, double most_ms) {
  const double started = spec.own_seconds();
  while (1e3 * (spec.own_seconds() - started) < most_ms && may_compile(spec)) {
    std::vector<Wanted> wanted;
    for (ComposedSolid& solid : *spec.composed_solids) {
      double often = 0;
      for (const auto& [volume, share] : solid.scenes) {
        if (but.contains(volume)) continue;
        often += share * static_cast<double>(spec.facts.touchables[volume]);
      }
      if (solid.tried || often == 0) continue;
      wanted.push_back({&solid, gain_of_code_for(solid) * often / solid.compile_ms});
    }
    if (wanted.empty() || !make(spec, most_urgent(spec, wanted, most_solids_ms))) return;
  }
}

}  // namespace navjit
