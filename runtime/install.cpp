#include "runtime/install.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <optional>

#include "geometry/navigation/generic.hpp"
#include "runtime/bind_to_data.hpp"
#include "runtime/judge.hpp"
#include "runtime/log_text.hpp"
#include "runtime/plugin.hpp"
#include "runtime/verify.hpp"

namespace navjit {
namespace {

constexpr std::size_t states_made_up = 400;  ///< per volume, for verification
/// Replayed alone, a scene's code is not what it is among that of its neighbours, compiled as well:
/// only what is clearly slower is not tried in the run. Where nothing is tried, what timings of a
/// few hundred steps can tell decides.
constexpr double most_of_bar_to_be_tried = 1.05, most_of_bar = 0.95;
/// A scene that was measured to be no faster is tried again once it is that many times as hot.
constexpr double try_again_after = 16;

/// A module's code, and the records that point into it.
struct Installed {
  jit::Code code;
  std::vector<std::shared_ptr<const codegen::Arena>> tables;
  std::vector<kernels::DispatchEntry> records;
};

/// The functions of an entry; null where the code has them not. A safety need not be there: then it
/// is that of what is bound to data, or the generic navigator's.
kernels::DispatchEntry find_entry(const Specialisation& spec, const jit::Code& code,
                                  const codegen::Entry& entry, const void* data) {
  const auto step = code.function<std::remove_pointer_t<kernels::StepFunction>>(entry.step);
  const auto relocate =
      code.function<std::remove_pointer_t<kernels::RelocateFunction>>(entry.relocate);
  kernels::DispatchEntry found{step ? *step : nullptr, relocate ? *relocate : nullptr, nullptr,
                               data, data};
  if (entry.safety.empty()) {
    const auto bound = spec.without_code.find(entry.volume);
    const kernels::DispatchEntry& other =
        bound == spec.without_code.end() ? generic::dispatch_entry : *bound->second;
    found.safety = other.safety;
    found.safety_data = other.safety_data;
  } else {
    const auto safety = code.function<std::remove_pointer_t<kernels::SafetyFunction>>(entry.safety);
    found.safety = safety ? *safety : nullptr;
  }
  return found;
}

/// Verifies, times and installs one scene. The report with what came of it, or what was wrong.
Expected<SceneReport> install_scene(Specialisation& spec, VolumeId volume,
                                    const kernels::DispatchEntry& record,
                                    const std::shared_ptr<const void>& owner, bool only_if_faster,
                                    SceneReport report, Binding binding) {
  const Geometry& geometry = spec.shared->geometry;
  const kernels::Context& context = spec.shared->table.context();
  const double begun = steady_seconds();
  std::vector<Sample> samples = spec.samples[volume];
  const std::size_t recorded = samples.size();
  const std::vector<Sample> made_up = spec.sampler.states(volume, states_made_up, volume + 1);
  samples.insert(samples.end(), made_up.begin(), made_up.end());
  const Faults& faults = spec.shared->faults;
  if (faults.fail_verification) return Failure{"injected failure"};
  if (!faults.skip_verification) {
    std::string problem = verify(geometry, context, record, volume, samples);
    if (!problem.empty()) return Failure{std::move(problem)};
  }

  const std::span<const Sample> timed =
      recorded > 0 ? std::span(samples).first(recorded) : std::span<const Sample>(samples);
  const double generic_ns = time_per_step(geometry, context, generic::dispatch_entry, timed);
  const double specialised_ns = time_per_step(geometry, context, record, timed);
  const bool forced = spec.forced.contains(spec.facts.first_equal[volume]) || !only_if_faster;
  // What is bound to data stays unless constants win something over that, too.
  const double bar = std::min(generic_ns, bound_ns(spec, volume));
  const bool tried = spec.shared->options.jit != JitMode::wait;
  const double most = (tried ? most_of_bar_to_be_tried : most_of_bar) * bar;
  const bool pays =
      forced || faults.skip_replay || (tried && recorded < few_recorded) || specialised_ns <= most;
  if (pays) {
    spec.shared->table.install(volume, &record, owner);
    if (only_if_faster) try_out(spec, volume, &record, owner);
  }
  spec.shared->log->debug(
      "event={} at_s={:.3f} scene={} generic_ns={:.1f} specialised_ns={:.1f} states={} recorded={} "
      "verification_ms={:.2f}",
      pays ? "installed" : "slower", spec.seconds(),
      in_quotes(geometry.world().volumes[volume].name), generic_ns, specialised_ns, samples.size(),
      recorded, (steady_seconds() - begun) * 1e3);
  if (binding == Binding::structure) {
    // Nothing is said of the scene's own code.
    const std::lock_guard lock(spec.mutex);
    report.status = SceneStatus::generic;
    report.generic_ns_per_step = generic_ns;
    if (!pays) {
      const SceneReport& before = spec.scenes[volume];
      report.binding = before.binding;
      report.specialised_ns_per_step = before.specialised_ns_per_step;
      report.swapped_at_s = before.swapped_at_s;
      return report;
    }
    report.binding = binding;
    report.specialised_ns_per_step = specialised_ns;
    report.swapped_at_s = spec.seconds();
    return report;
  }
  if (!pays) {
    const VolumeId first = spec.facts.first_equal[volume];
    spec.try_again_at[first] = try_again_after * spec.execution_counts[first];
  }
  report.status = pays ? SceneStatus::specialised : SceneStatus::unprofitable;
  report.note = pays ? "" : "measured no faster than what is there";
  report.generic_ns_per_step = generic_ns;
  report.specialised_ns_per_step = pays ? specialised_ns : 0;
  report.swapped_at_s = pays ? spec.seconds() : 0;
  if (pays) {
    report.binding = Binding::constants;
    spec.bound.insert(volume);
  } else if (const std::lock_guard lock(spec.mutex);
             spec.scenes[volume].binding != Binding::generic) {
    report.binding = spec.scenes[volume].binding;
    report.specialised_ns_per_step = spec.scenes[volume].specialised_ns_per_step;
    report.swapped_at_s = spec.scenes[volume].swapped_at_s;
  }
  return report;
}

/// Finds one scene's functions in the code, and installs them. Nothing if they are wrong, which is
/// noted unless they came from the cache. The report is not yet the scene's.
std::optional<SceneReport> install_entry(Specialisation& spec,
                                         const std::shared_ptr<Installed>& installed,
                                         const codegen::Entry& entry, const void* data, bool cached,
                                         Binding binding, double compile_ms) {
  SceneReport begun;
  begun.compile_ms = compile_ms;
  begun.origin = cached ? CodeOrigin::cache : CodeOrigin::compiler;
  const kernels::DispatchEntry record = find_entry(spec, installed->code, entry, data);
  const bool whole =
      record.step != nullptr && record.relocate != nullptr && record.safety != nullptr;
  Expected<SceneReport> report =
      whole ? install_scene(spec, entry.volume, installed->records.emplace_back(record), installed,
                            spec.shared->options.specialiser.keep_only_faster, std::move(begun),
                            binding)
            : Failure{"the generated function is missing"};
  if (report) return *std::move(report);
  if (!cached) note_failure(spec, entry.volume, report.failure().message);
  return std::nullopt;
}

}  // namespace

void count_module(Specialisation& spec, bool cached, std::size_t code_bytes, double start) {
  const std::lock_guard lock(spec.mutex);
  ++spec.totals.modules;
  spec.totals.cached_modules += cached ? 1 : 0;
  spec.totals.compile_ms += (steady_seconds() - start) * 1e3;
  spec.totals.code_bytes += code_bytes;
}

bool install(Specialisation& spec, const codegen::Module& module, jit::Code code, bool cached,
             double start) {
  const double compile_ms = (steady_seconds() - start) * 1e3;
  const std::size_t code_bytes = code.report().code_bytes;
  auto installed = std::make_shared<Installed>(Installed{std::move(code), {module.owner}, {}});
  bool all_good = true;
  installed->records.reserve(module.entries.size());  // pointers to records are published
  for (const codegen::Entry& entry : module.entries) {
    if (spec.stopping()) {
      all_good = false;
      break;
    }
    std::optional<SceneReport> report =
        install_entry(spec, installed, entry, module.data_of(entry), cached, Binding::constants,
                      compile_ms / static_cast<double>(module.entries.size()));
    if (!report) {
      if (cached) return false;
      all_good = false;
      continue;
    }
    const std::lock_guard lock(spec.mutex);
    spec.scenes[entry.volume] = *std::move(report);
  }
  count_module(spec, cached, code_bytes, start);
  if (cached) {
    spec.shared->log->debug(
        "event=cached at_s={:.3f} scenes={} ms={:.1f} with_verification_ms={:.1f}", spec.seconds(),
        module.entries.size(), compile_ms, (steady_seconds() - start) * 1e3);
  }
  return all_good;
}

bool install_structure(Specialisation& spec, const std::vector<codegen::Module>& scenes,
                       jit::Code code, bool cached, double start) {
  const double compile_ms = (steady_seconds() - start) * 1e3;
  const std::size_t code_bytes = code.report().code_bytes;
  auto installed = std::make_shared<Installed>(Installed{std::move(code), {}, {}});
  installed->records.reserve(scenes.size());  // pointers to records are published
  for (const codegen::Module& module : scenes) installed->tables.push_back(module.owner);
  spec.structures.insert(installed);
  bool all_good = true;
  for (const codegen::Module& module : scenes) {
    if (spec.stopping()) return false;
    const codegen::Entry& entry = module.entries[0];
    std::optional<SceneReport> report =
        install_entry(spec, installed, entry, module.data_of(entry), cached, Binding::structure,
                      compile_ms / static_cast<double>(scenes.size()));
    if (!report) {
      if (cached) return false;
      all_good = false;
      continue;
    }
    if (report->binding != Binding::structure) continue;  // what is there is no slower
    const std::lock_guard lock(spec.mutex);
    spec.scenes[entry.volume] = *std::move(report);
  }
  count_module(spec, cached, code_bytes, start);
  return all_good;
}

void install_plugin(Specialisation& spec, const std::string& path) {
  const auto plugin = Plugin::load(path, spec.shared->geometry);
  if (!plugin) {
    spec.shared->log->warn("plugin not used: {}", plugin.failure().message);
    return;
  }
  for (const Plugin::Entry& entry : (*plugin)->entries()) {
    if (spec.off.contains(entry.volume)) continue;
    SceneReport begun;
    begun.origin = CodeOrigin::plugin;
    // Whoever made the plugin chose its scenes: production shall not depend on a timing.
    Expected<SceneReport> report = install_scene(spec, entry.volume, entry.dispatch, *plugin, false,
                                                 std::move(begun), Binding::constants);
    if (report) {
      const std::lock_guard lock(spec.mutex);
      spec.scenes[entry.volume] = *std::move(report);
      ++spec.totals.plugin_scenes;
    } else {
      spec.shared->log->warn("plugin {}: scene {} not used: {}", path,
                             spec.shared->geometry.world().volumes[entry.volume].name,
                             report.failure().message);
    }
  }
}

}  // namespace navjit
