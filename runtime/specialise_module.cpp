// The part of the specialiser that makes modules and installs what they hold.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>

#include "geometry/navigation/generic.hpp"
#include "jit/activity.hpp"
#include "runtime/fingerprint.hpp"
#include "runtime/log_text.hpp"
#include "runtime/plugin.hpp"
#include "runtime/specialiser.hpp"
#include "runtime/verify.hpp"

namespace navjit {
namespace {

constexpr std::size_t states_made_up = 400;  ///< per volume, for verification
/// Timings of a few hundred steps are no better than this; between detectors' rays and the states
/// that are timed there is more than that.
constexpr double least_gain = 0.95;
/// A scene that was measured to be no faster is tried again once it is that many times as hot.
constexpr double try_again_after = 16;

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A module's code, and the records that point into it.
struct Installed {
  jit::Code code;
  std::vector<kernels::DispatchEntry> records;
};

/// The functions of an entry; null where the code has them not. A safety need not be there.
kernels::DispatchEntry find_entry(const jit::Code& code, const codegen::Entry& entry) {
  const auto step = code.function<std::remove_pointer_t<kernels::StepFunction>>(entry.step);
  const auto relocate =
      code.function<std::remove_pointer_t<kernels::RelocateFunction>>(entry.relocate);
  const auto safety = code.function<std::remove_pointer_t<kernels::SafetyFunction>>(entry.safety);
  return {step ? *step : nullptr, relocate ? *relocate : nullptr,
          entry.safety.empty() ? generic::dispatch_entry.safety
          : safety             ? *safety
                               : nullptr};
}

/// What people see of a module in the cache: how many scenes, and the first of them.
std::string label_of(const World& world, const std::vector<VolumeId>& batch) {
  std::string label = std::to_string(batch.size()) + (batch.size() == 1 ? " scene: " : " scenes: ");
  for (std::size_t i = 0; i < batch.size() && label.size() < 160; ++i) {
    label += (i == 0 ? "" : ", ") + world.volumes[batch[i]].name;
  }
  return label;
}

/// Of the recorded rays, those that run along planes of the scene's axes.
std::size_t along_axes(const Geometry& geometry, const std::vector<Sample>& samples) {
  const auto stack = std::make_unique<NavigationStack>();
  stack->depth = -1;
  return static_cast<std::size_t>(
      std::count_if(samples.begin(), samples.end(), [&](const Sample& s) {
        generic::restore(geometry, *stack, s.touchable);
        return !kernels::is_oblique(kernels::to_local_heading(
            stack->levels[stack->depth], s.direction.x, s.direction.y, s.direction.z));
      }));
}

}  // namespace

bool Specialiser::takes_rays_along_faces(const std::vector<VolumeId>& batch) {
  std::size_t along = 0, all = 0;
  for (const VolumeId volume : batch) {
    if (left_out_too_much_.contains(facts_.first_equal[volume])) return true;
    along += along_axes(shared_->geometry, samples_[volume]);
    all += samples_[volume].size();
  }
  return along * bail_out_share > all;
}

codegen::Module Specialiser::generate(const std::vector<VolumeId>& batch, bool along_faces) {
  facts_.along_faces.clear();
  if (along_faces) {
    for (const VolumeId volume : batch) facts_.along_faces.insert(facts_.first_equal[volume]);
  }
  return codegen::generate(shared_->geometry, facts_, batch);
}

bool Specialiser::make_module(const std::vector<VolumeId>& batch) {
  const double start = now();
  codegen::Module module = generate(batch, takes_rays_along_faces(batch));
  if (shared_->faults.edit_source) shared_->faults.edit_source(module.source);
  if (auto found = maker_->find(module.source)) {
    if (install(module, std::move(found->code), true, start)) return true;
    if (stopping()) return false;
    maker_->reject(module.source);
  }
  auto made = compile(module.source);
  if (!made) {
    if (!made.failure().stopped) no_module(batch, made.failure());
    return false;
  }
  const jit::CompileReport& report = made->object.report;
  const double expected = expected_ms(batch), took = (now() - start) * 1e3;
  shared_->log->debug(
      "event=compiled at_s={:.3f} scenes={} ms={:.0f} expected_ms={:.0f} source_kb={} "
      "frontend_ms={:.0f} optimise_ms={:.0f} codegen_ms={:.0f} code_kb={}",
      seconds(), batch.size(), took, expected, module.source.size() / 1024, report.frontend_ms,
      report.optimise_ms, report.codegen_ms, report.code_bytes / 1024);
  if (install(module, std::move(made->code), false, start)) {
    maker_->keep(module.source, label_of(shared_->geometry.world(), batch), made->object);
  }
  return true;
}

Expected<CodeMaker::Made> Specialiser::compile(const std::string& source) {
  {
    const std::lock_guard lock(mutex_);
    if (stopping()) return stopped();
    compiling_ = true;
    wake_.notify_all();
  }
  Expected<CodeMaker::Made> made = stopped();
  try {
    if (shared_->faults.compiling) shared_->faults.compiling();
    made = maker_->compile(source, stop_.get_token());
  } catch (const std::bad_alloc&) {
    made = out_of_memory();
  }
  const std::lock_guard lock(mutex_);
  compiling_ = false;
  // Nobody waits for it then, and what is this thread's may be in use.
  if (stopping()) return stopped();
  return made;
}

double Specialiser::expected_ms(const std::vector<VolumeId>& batch) const {
  double sum = module_base_ms;
  for (const VolumeId volume : batch) {
    const auto known = candidates_.find(volume);
    if (known == candidates_.end()) return 0;
    sum += known->second.compile_ms;
  }
  return sum;
}

void Specialiser::no_module(const std::vector<VolumeId>& batch, const Failure& failure) {
  const std::string& why = failure.message;
  if (failure.exhausted || !maker_->no_compiler().empty() || !maker_->no_linker().empty()) {
    shared_->log->warn("nothing more is specialised in this run: {}", one_line(why));
    hopeless_ = true;
    for (const VolumeId volume : batch) note(volume, SceneStatus::generic, why);
    return;
  }
  if (batch.size() > 1) {
    // One scene may have spoilt the module for all.
    for (const VolumeId volume : batch) {
      if (!hopeless_ && !stopping()) make_module({volume});
    }
    return;
  }
  shared_->log->warn("scene {} stays generic: {}", shared_->geometry.world().volumes[batch[0]].name,
                     one_line(why));
  note(batch[0], SceneStatus::failed, why);
}

bool Specialiser::install(const codegen::Module& module, jit::Code code, bool cached,
                          double start) {
  const double compile_ms = (now() - start) * 1e3;
  const std::size_t code_bytes = code.report().code_bytes;
  auto installed = std::make_shared<Installed>(Installed{std::move(code), {}});
  bool all_good = true;
  installed->records.reserve(module.entries.size());  // pointers to records are published
  for (const codegen::Entry& entry : module.entries) {
    if (stopping()) {
      all_good = false;
      break;
    }
    SceneReport report;
    report.compile_ms = compile_ms / static_cast<double>(module.entries.size());
    report.origin = cached ? CodeOrigin::cache : CodeOrigin::compiler;
    std::string problem = "the generated function is missing";
    const kernels::DispatchEntry record = find_entry(installed->code, entry);
    if (record.step == nullptr || record.relocate == nullptr || record.safety == nullptr ||
        !install_scene(entry.volume, installed->records.emplace_back(record), installed,
                       shared_->options.specialiser.keep_only_faster, report, problem)) {
      if (cached) return false;
      note_failure(entry.volume, problem);
      all_good = false;
      continue;
    }
    const std::lock_guard lock(mutex_);
    scenes_[entry.volume] = std::move(report);
  }
  const std::lock_guard lock(mutex_);
  ++totals_.modules;
  totals_.cached_modules += cached ? 1 : 0;
  totals_.compile_ms += (now() - start) * 1e3;
  totals_.code_bytes += code_bytes;
  if (cached) {
    shared_->log->debug("event=cached at_s={:.3f} scenes={} ms={:.1f} with_verification_ms={:.1f}",
                        seconds(), module.entries.size(), compile_ms, (now() - start) * 1e3);
  }
  return all_good;
}

bool Specialiser::install_scene(VolumeId volume, const kernels::DispatchEntry& record,
                                const std::shared_ptr<const void>& owner, bool only_if_faster,
                                SceneReport& report, std::string& problem) {
  const Geometry& geometry = shared_->geometry;
  const kernels::Context& context = shared_->table.context();
  const double begun = now();
  std::vector<Sample> samples = samples_[volume];
  const std::size_t recorded = samples.size();
  const std::vector<Sample> made_up = sampler_.states(volume, states_made_up, volume + 1);
  samples.insert(samples.end(), made_up.begin(), made_up.end());
  const Faults& faults = shared_->faults;
  problem = faults.skip_verification ? "" : verify(geometry, context, record, volume, samples);
  if (faults.fail_verification) problem = "injected failure";
  if (!problem.empty()) return false;

  const std::span<const Sample> timed =
      recorded > 0 ? std::span(samples).first(recorded) : std::span<const Sample>(samples);
  const double generic_ns = time_per_step(geometry, context, generic::dispatch_entry, timed);
  const double specialised_ns = time_per_step(geometry, context, record, timed);
  const bool forced =
      facts_.forced_candidates.contains(facts_.first_equal[volume]) || !only_if_faster;
  // What is bound to data stays unless constants win something over that, too.
  const double bar = std::min(generic_ns, bound_ns(volume));
  const bool pays = forced || specialised_ns <= least_gain * bar || timed.size() < 16;
  if (pays) shared_->table.install(volume, &record, owner);
  shared_->log->debug(
      "event={} at_s={:.3f} scene={} generic_ns={:.1f} specialised_ns={:.1f} states={} recorded={} "
      "verification_ms={:.2f}",
      pays ? "installed" : "slower", seconds(), quoted(geometry.world().volumes[volume].name),
      generic_ns, specialised_ns, samples.size(), recorded, (now() - begun) * 1e3);
  if (!pays) {
    const VolumeId first = facts_.first_equal[volume];
    try_again_at_[first] = try_again_after * execution_counts_[first];
  }
  report.status = pays ? SceneStatus::specialised : SceneStatus::unprofitable;
  report.note = pays ? "" : "measured no faster than what is there";
  report.generic_ns_per_step = generic_ns;
  report.specialised_ns_per_step = pays ? specialised_ns : 0;
  report.swapped_at_s = pays ? seconds() : 0;
  if (pays) {
    report.binding = Binding::constants;
    bound_.insert(volume);
  } else if (const std::lock_guard lock(mutex_); scenes_[volume].binding == Binding::data) {
    report.binding = Binding::data;
    report.specialised_ns_per_step = scenes_[volume].specialised_ns_per_step;
    report.swapped_at_s = scenes_[volume].swapped_at_s;
  }
  return true;
}

void Specialiser::install_plugin(const std::string& path) {
  const auto plugin = Plugin::load(path, shared_->geometry);
  if (!plugin) {
    shared_->log->warn("plugin not used: {}", plugin.failure().message);
    return;
  }
  for (const Plugin::Entry& entry : (*plugin)->entries()) {
    SceneReport report;
    report.origin = CodeOrigin::plugin;
    std::string problem;
    // Whoever made the plugin chose its scenes: production shall not depend on a timing.
    if (install_scene(entry.volume, entry.navigators, *plugin, false, report, problem)) {
      const std::lock_guard lock(mutex_);
      scenes_[entry.volume] = std::move(report);
      ++totals_.plugin_scenes;
    } else {
      shared_->log->warn("plugin {}: scene {} not used: {}", path,
                         shared_->geometry.world().volumes[entry.volume].name, problem);
    }
  }
}

void Specialiser::install_remembered() {
  if (!maker_->has_cache()) return;
  const Geometry& geometry = shared_->geometry;
  module_list_name_ = "hot scenes of " + geometry_fingerprint(geometry);
  const std::optional<std::string> text = maker_->recall(module_list_name_);
  const std::optional<ModuleList> list =
      text ? read_module_list(*text, geometry.size()) : std::optional<ModuleList>();
  if (!list) return;
  for (const std::vector<VolumeId>& batch : *list) {
    {
      const std::lock_guard lock(mutex_);
      const bool fresh = std::all_of(batch.begin(), batch.end(), [&](VolumeId v) {
        return facts_.reachable[v] && facts_.first_equal[v] == v && !scenes_.contains(v);
      });
      if (stopping()) return;
      if (!fresh) continue;
    }
    // What the cache has no more is left to the profile of this run.
    for (const bool along_faces : {false, true}) {
      const double start = now();
      const codegen::Module module = generate(batch, along_faces);
      auto found = maker_->find(module.source);
      if (!found) continue;
      if (install(module, std::move(found->code), true, start)) {
        module_list_.push_back(batch);
      } else if (!stopping()) {
        maker_->reject(module.source);
      }
      break;
    }
  }
}

void Specialiser::remember(const std::vector<VolumeId>& batch) {
  if (!maker_->has_cache() || shared_->options.jit == JitMode::wait) return;
  module_list_.push_back(batch);
  // Other runs of the same detector may have found other scenes meanwhile.
  const std::optional<std::string> text = maker_->recall(module_list_name_);
  const std::optional<ModuleList> others =
      text ? read_module_list(*text, shared_->geometry.size()) : std::optional<ModuleList>();
  const ModuleList merged = others ? merge(module_list_, *others) : module_list_;
  if (others && *others == merged) return;
  maker_->remember(module_list_name_, "which scenes are hot in a detector",
                   write_module_list(merged));
}

}  // namespace navjit
