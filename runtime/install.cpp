#include "runtime/install.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "geometry/navigation/generic.hpp"
#include "runtime/bind_to_data.hpp"
#include "runtime/judge.hpp"
#include "runtime/log_text.hpp"
#include "runtime/plugin.hpp"
#include "runtime/verify.hpp"

namespace navjit {
namespace {

constexpr std::size_t states_made_up = 400;  ///< per volume, for verification
/// The same for a volume whose equals have already verified the code. Only the table of its
/// daughters' volumes is its own.
constexpr std::size_t states_made_up_for_equals = 32;
/// How long code may take on recorded states, as a share of the time of the present navigator. The
/// code of a single scene behaves differently in a replay than among the compiled code of its
/// neighbours, so it is rejected before a trial only if it is clearly slower. If no trial follows,
/// timings of a few hundred steps decide, and the code has to be clearly faster.
constexpr double most_of_bar_to_be_tried = 1.05, most_of_bar = 0.95;
/// A scene that was measured to be no faster is tried again once it is this many times as hot.
constexpr double try_again_after = 16;

/// A module's code, and the dispatch entries that point into it.
struct Installed {
  jit::Code code;
  std::vector<std::shared_ptr<const codegen::Arena>> tables;
  std::vector<kernels::DispatchEntry> records;
};

/// The functions of an entry; null if the code does not have them. An entry without a safety gets
/// that of the navigator that is bound to data, or the generic navigator's.
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

/// The recorded states of a volume followed by some made-up ones, and how many are recorded.
struct States {
  std::vector<Sample> all;
  std::size_t recorded;
};
States states_of(Specialisation& spec, VolumeId volume, std::size_t made_up) {
  States states{spec.samples[volume], 0};
  states.recorded = states.all.size();
  const std::vector<Sample> more = spec.sampler.states(volume, made_up, volume + 1);
  states.all.insert(states.all.end(), more.begin(), more.end());
  return states;
}

/// What is wrong with a scene's dispatch entry, in words; empty if nothing is.
std::string proved(const Specialisation& spec, VolumeId volume,
                   const kernels::DispatchEntry& record, const std::vector<Sample>& states) {
  const Faults& faults = spec.shared->faults;
  if (faults.fail_verification) return injected_failure;
  if (faults.skip_verification) return "";
  return verify(spec.shared->geometry, spec.shared->table.context(), record, volume, states);
}

struct StepTimes {
  double generic_ns, specialised_ns;
};

/// The report on a volume whose code for constants was tried. If it `pays` it is installed,
/// otherwise the navigator before it stays.
SceneReport report_on_constants(Specialisation& spec, VolumeId volume, SceneReport report,
                                bool pays, const StepTimes& times) {
  report.status = pays ? SceneStatus::specialised : SceneStatus::unprofitable;
  report.note = pays ? "" : "measured no faster than what is there";
  report.generic_ns_per_step = times.generic_ns;
  report.specialised_ns_per_step = pays ? times.specialised_ns : 0;
  report.swapped_at_s = pays ? spec.seconds() : 0;
  if (pays) {
    report.binding = Binding::constants;
    spec.bound.insert(volume);
    return report;
  }
  const std::lock_guard lock(spec.mutex);
  const SceneReport& before = spec.scenes[volume];
  if (before.binding == Binding::generic) return report;
  report.binding = before.binding;
  report.specialised_ns_per_step = before.specialised_ns_per_step;
  report.swapped_at_s = before.swapped_at_s;
  return report;
}

/// Verifies, times and installs one scene. Returns the report with the result, or what was wrong.
Expected<SceneReport> install_scene(Specialisation& spec, VolumeId volume,
                                    const kernels::DispatchEntry& record,
                                    const std::shared_ptr<const void>& owner, bool only_if_faster,
                                    SceneReport report, Binding binding) {
  const Geometry& geometry = spec.shared->geometry;
  const kernels::Context& context = spec.shared->table.context();
  const double begun = steady_seconds();
  const auto [samples, recorded] = states_of(spec, volume, states_made_up);
  std::string problem = proved(spec, volume, record, samples);
  if (!problem.empty()) return Failure{std::move(problem)};

  const Faults& faults = spec.shared->faults;
  const std::span<const Sample> timed =
      recorded > 0 ? std::span(samples).first(recorded) : std::span<const Sample>(samples);
  const double generic_ns = time_per_step(geometry, context, generic::dispatch_entry, timed);
  const double specialised_ns = time_per_step(geometry, context, record, timed);
  const bool forced = spec.forced.contains(spec.facts.first_equal[volume]) || !only_if_faster;
  // A navigator that is bound to data stays unless constants gain something over it, too.
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
    // The status is about code compiled for this scene alone, and there is none yet.
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
  return report_on_constants(spec, volume, std::move(report), pays, {generic_ns, specialised_ns});
}

/// The same for a scene that shares its code with the hottest of its equals: it is verified, but
/// not timed, and installed if the code pays for the hottest one, whose report is given.
Expected<SceneReport> install_as_equal(Specialisation& spec, VolumeId volume,
                                       const kernels::DispatchEntry& record,
                                       const std::shared_ptr<const void>& owner,
                                       bool only_if_faster, SceneReport report,
                                       const SceneReport& hottest) {
  const bool pays = hottest.status == SceneStatus::specialised;
  if (pays) {
    std::string problem =
        proved(spec, volume, record, states_of(spec, volume, states_made_up_for_equals).all);
    if (!problem.empty()) return Failure{std::move(problem)};
    spec.shared->table.install(volume, &record, owner);
    if (only_if_faster) try_out(spec, volume, &record, owner);
    spec.shared->log->debug("event=shared at_s={:.3f} scene={}", spec.seconds(),
                            in_quotes(spec.shared->geometry.world().volumes[volume].name));
  }
  return report_on_constants(spec, volume, std::move(report), pays,
                             {hottest.generic_ns_per_step, hottest.specialised_ns_per_step});
}

/// The entries without those that are off. Volumes that share code follow one another in the list;
/// the hottest of them comes first.
std::vector<codegen::Entry> hottest_first(const Specialisation& spec,
                                          std::vector<codegen::Entry> entries) {
  std::erase_if(entries, [&](const codegen::Entry& e) { return spec.off.contains(e.volume); });
  const auto first = [&](const codegen::Entry& e) { return spec.facts.first_equal[e.volume]; };
  for (auto begin = entries.begin(); begin != entries.end();) {
    const auto end = std::find_if(
        begin, entries.end(), [&](const codegen::Entry& e) { return first(e) != first(*begin); });
    const VolumeId hottest = hottest_equal(spec, first(*begin));
    const auto it =
        std::find_if(begin, end, [&](const codegen::Entry& e) { return e.volume == hottest; });
    if (it != end) std::iter_swap(begin, it);
    begin = end;
  }
  return entries;
}

/// Finds one scene's functions in the code, and installs them. Nothing if they are wrong, which is
/// noted unless they came from the cache. The report is not yet the scene's. `hottest`: the report
/// of the hottest volume that shares the functions; null if it is this one.
std::optional<SceneReport> install_entry(Specialisation& spec,
                                         const std::shared_ptr<Installed>& installed,
                                         const codegen::Entry& entry, const void* data, bool cached,
                                         Binding binding, double compile_ms,
                                         const SceneReport* hottest = nullptr) {
  SceneReport begun;
  begun.compile_ms = compile_ms;
  begun.origin = cached ? CodeOrigin::cache : CodeOrigin::compiler;
  const kernels::DispatchEntry record = find_entry(spec, installed->code, entry, data);
  const bool whole =
      record.step != nullptr && record.relocate != nullptr && record.safety != nullptr;
  Expected<SceneReport> report = Failure{"the generated function is missing"};
  if (whole) {
    const kernels::DispatchEntry& kept = installed->records.emplace_back(record);
    const bool only_if_faster = spec.shared->options.specialiser.keep_only_faster;
    report = hottest != nullptr ? install_as_equal(spec, entry.volume, kept, installed,
                                                   only_if_faster, std::move(begun), *hottest)
                                : install_scene(spec, entry.volume, kept, installed, only_if_faster,
                                                std::move(begun), binding);
  }
  if (report) return *std::move(report);
  if (!cached) note_failure(spec, entry.volume, report.failure().message);
  return std::nullopt;
}

/// Notes that a volume does not get code that was wrong for another volume which shares it. The log
/// has already said so of the other one.
void note_wrong_as_equal(Specialisation& spec, VolumeId volume) {
  const std::lock_guard lock(spec.mutex);
  SceneReport& scene = spec.scenes[volume];
  scene.status = SceneStatus::failed;
  scene.note = "its code was wrong for a volume that shares it";
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
  // What is known of the volumes that share code with the next one: the hottest's report, and
  // whether the code was wrong for any of them.
  std::optional<SceneReport> hottest;
  bool wrong = false;
  VolumeId first = 0;
  for (const codegen::Entry& entry : hottest_first(spec, module.entries)) {
    if (spec.stopping()) {
      all_good = false;
      break;
    }
    if (const VolumeId of_entry = spec.facts.first_equal[entry.volume]; of_entry != first) {
      hottest.reset();
      wrong = false;
      first = of_entry;
    }
    if (wrong) {
      note_wrong_as_equal(spec, entry.volume);
      continue;
    }
    std::optional<SceneReport> report = install_entry(
        spec, installed, entry, module.data_of(entry), cached, Binding::constants,
        compile_ms / static_cast<double>(module.entries.size()), hottest ? &*hottest : nullptr);
    if (!report) {
      if (cached) return false;
      all_good = false;
      wrong = true;
      continue;
    }
    if (!hottest) hottest = report;
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
  // A trial may show its code in the table while the table owns another, and navigators may be in
  // this code after the runtime is gone.
  spec.shared->table.keep(installed);
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
  // The scenes were chosen when the plugin was made, and all of them are installed. Whether they
  // are faster than what else there is, only the run can tell.
  const bool on_trial =
      spec.shared->options.jit == JitMode::on && spec.shared->options.specialiser.keep_only_faster;
  // Reports on what was timed, by the first of equal volumes and the step function that they share.
  std::map<std::pair<VolumeId, kernels::StepFunction>, SceneReport> timed;
  for (const Plugin::Entry& entry : (*plugin)->entries()) {
    if (spec.off.contains(entry.volume)) continue;
    SceneReport begun;
    begun.origin = CodeOrigin::plugin;
    const std::pair code(spec.facts.first_equal[entry.volume], entry.dispatch.step);
    const auto equal = timed.find(code);
    Expected<SceneReport> report =
        equal == timed.end() ? install_scene(spec, entry.volume, entry.dispatch, *plugin, on_trial,
                                             std::move(begun), Binding::constants)
                             : install_as_equal(spec, entry.volume, entry.dispatch, *plugin,
                                                on_trial, std::move(begun), equal->second);
    if (report) timed.try_emplace(code, *report);
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
