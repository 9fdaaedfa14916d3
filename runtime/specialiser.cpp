#include "runtime/specialiser.hpp"

#include <spdlog/spdlog.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>

#include "analysis/plan.hpp"
#include "geometry/navigation/generic.hpp"
#include "jit/activity.hpp"
#include "runtime/code_maker.hpp"
#include "runtime/fingerprint.hpp"
#include "runtime/log_text.hpp"
#include "runtime/overrides.hpp"
#include "runtime/verify.hpp"

namespace navjit {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t samples_kept = 512;  ///< per volume
constexpr std::size_t fresh_kept = 64;     ///< per volume and look

/// What constants win of a data-bound step, on average (docs/decisions.md).
constexpr double gain_over_data = 0.35;

double now() { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); }

}  // namespace

const char* status_name(SceneStatus status) {
  switch (status) {
    case SceneStatus::generic:
      return "generic";
    case SceneStatus::compiling:
      return "compiling";
    case SceneStatus::specialised:
      return "specialised";
    case SceneStatus::unprofitable:
      return "unprofitable";
    case SceneStatus::failed:
      return "failed";
  }
  return "unknown";
}

const char* binding_name(Binding binding) {
  switch (binding) {
    case Binding::generic:
      return "generic";
    case Binding::data:
      return "data";
    case Binding::constants:
      return "constants";
  }
  return "unknown";
}

const char* origin_name(CodeOrigin origin) {
  switch (origin) {
    case CodeOrigin::none:
      return "";
    case CodeOrigin::compiler:
      return "compiled";
    case CodeOrigin::cache:
      return "cache";
    case CodeOrigin::plugin:
      return "plugin";
  }
  return "unknown";
}

Specialiser::Specialiser(std::shared_ptr<detail::Shared> shared)
    : shared_(std::move(shared)),
      facts_(analyse_world(shared_->geometry)),
      sampler_(shared_->geometry),
      steps_(shared_->geometry.size(), 0),
      steps_below_(shared_->geometry.size(), 0),
      execution_counts_(shared_->geometry.size(), 0),
      recent_(shared_->geometry.size(), 0),
      started_at_(now()) {
  facts_.with_safety = shared_->options.specialiser.safety;
  if (shared_->options.jit == JitMode::off) return;
  apply_overrides();
  if (!jit::has_compiler()) {
    return;
  }
  maker_ = std::make_unique<CodeMaker>(shared_->options.specialiser, shared_->options.cache,
                                       shared_->log);
}

void Specialiser::apply_overrides() {
  const char* text = std::getenv(overrides_variable);
  if (text == nullptr) return;
  std::string complaints;
  for (const auto& [volume, variant] :
       parse_overrides(shared_->geometry.world(), text, &complaints)) {
    // Equal volumes share a navigator, and so what is forced on one of them.
    const VolumeId first = facts_.first_equal[volume];
    if (variant == Variant::off) {
      note(first, SceneStatus::unprofitable, std::string("off by ") + overrides_variable);
      for (const VolumeId equal : facts_.equals[first]) bound_.insert(equal);
    } else {
      for (const VolumeId equal : facts_.equals[first]) {
        scenes_.erase(equal);
        bound_.erase(equal);
      }
      facts_.forced_candidates[first] = variant == Variant::all     ? Candidates::all
                                        : variant == Variant::lanes ? Candidates::lanes
                                        : variant == Variant::nest  ? Candidates::nest
                                        : variant == Variant::rings ? Candidates::rings
                                        : variant == Variant::grid  ? Candidates::grid
                                        : variant == Variant::tree  ? Candidates::tree
                                                                    : Candidates::boxes;
    }
  }
  if (!complaints.empty()) shared_->log->warn("{}: {}", overrides_variable, complaints);
}

void Specialiser::stop() {
  std::unique_lock lock(mutex_);
  stop_.request_stop();
  wake_.notify_all();
  if (!thread_.joinable()) return;
  wake_.wait(lock, [&] { return ended_ || compiling_; });
  const bool ended = ended_;
  for (auto& [volume, scene] : scenes_) {
    if (scene.status != SceneStatus::compiling) continue;
    scene.status = SceneStatus::generic;
    scene.note = "the run ended before it was compiled";
  }
  lock.unlock();
  if (ended) {
    thread_.join();
  } else {
    jit::outlast_activities();
    thread_.detach();
  }
}

double Specialiser::seconds() const { return now() - started_at_; }

void Specialiser::start() {
  hopeless_ = !maker_;
  try {
    thread_ = std::thread(
        [activity = std::make_unique<jit::Activity>(stop_), self = shared_from_this()]() mutable {
          // In this order: the last to own the specialiser takes the compiler down with it.
          const std::unique_ptr<jit::Activity> until_the_end = std::move(activity);
          const std::shared_ptr<Specialiser> own = std::move(self);
          own->run();
        });
  } catch (const std::exception& error) {
    hopeless_ = true;
    shared_->log->warn("nothing is specialised in this run: no thread for it: {}", error.what());
  }
}

void Specialiser::run() {
  // Of this thread, and of those that it makes for the compiler.
  setpriority(PRIO_PROCESS, 0, std::clamp(shared_->options.specialiser.nice, 0, 19));
  try {
    look_until_stopped();
  } catch (const std::exception& error) {
    if (!stopping())
      shared_->log->warn("nothing more is specialised in this run: {}", error.what());
  }
  const std::lock_guard lock(mutex_);
  ended_ = true;
  wake_.notify_all();
}

void Specialiser::look_until_stopped() {
  if (maker_) install_remembered();
  std::unique_lock lock(mutex_);
  while (!stopping()) {
    lock.unlock();
    gather();
    const bool more_to_bind = bind_hot_to_data();
    const std::vector<VolumeId> batch = more_to_bind ? std::vector<VolumeId>{} : choose();
    if (!batch.empty()) specialise(batch);
    if (stopping()) return;
    reconsider();
    const std::size_t waiting = shared_->table.reclaim();
    lock.lock();
    totals_.waiting_to_be_freed = waiting;
    ++looks_;
    const bool idle = batch.empty() && !more_to_bind;
    if (idle) idle_look_ = looks_;
    wake_.notify_all();
    if (idle) {
      wake_.wait_for(
          lock, std::chrono::duration<double, std::milli>(shared_->options.specialiser.poll_ms));
    }
  }
}

void Specialiser::wait_until_idle() {
  if (!thread_.joinable()) return;
  std::unique_lock lock(mutex_);
  // Two looks from now the counts of this moment were seen; what is due on them comes first.
  wake_.wait(lock,
             [&, target = looks_ + 2] { return ended_ || stopping() || idle_look_ >= target; });
}

void Specialiser::gather() {
  const detail::Counts counts = shared_->counts();
  for (std::size_t v = 0; v < steps_.size(); ++v)
    steps_[v] = counts.steps(static_cast<VolumeId>(v));
  for (const auto& profile : counts.profiles) {
    for (Sample sample; profile->take(sample);) {
      if (sample.mother != Sample::no_volume) steps_below_[sample.mother] += Profile::period;
      auto& fresh = fresh_[sample.volume];
      if (fresh.size() < fresh_kept) fresh.push_back(sample);
      auto& kept = samples_[sample.volume];
      if (kept.size() < samples_kept) {
        kept.push_back(sample);
      } else {
        // Newer states replace older ones here and there: the run may move on.
        kept[(steps_[sample.volume] * 2654435761U) % samples_kept] = sample;
      }
    }
  }
}

void Specialiser::update_execution_counts() {
  // Volumes of equal structure are hot together. Relocation in a mother costs about as much as a
  // step.
  std::vector<double> executions(steps_.size(), 0);
  for (std::size_t v = 0; v < steps_.size(); ++v) {
    executions[facts_.first_equal[v]] += static_cast<double>(steps_[v] + steps_below_[v]);
  }
  const double t = seconds();
  const double fades = std::exp2((counted_at_ - t) / shared_->options.specialiser.half_life_s);
  counted_at_ = t;
  for (std::size_t v = 0; v < executions.size(); ++v) {
    recent_[v] = fades * recent_[v] + executions[v] - execution_counts_[v];
  }
  execution_counts_ = std::move(executions);
}

std::vector<VolumeId> Specialiser::choose() {
  if (hopeless_ || !shared_->options.specialiser.constants) return {};
  SpecialiserOptions options = shared_->options.specialiser;
  // Until the first module is there nothing is won: it is to be there soon.
  if (totals_.modules == 0) options.module_ms /= 2;
  update_execution_counts();
  std::vector<Candidate> candidates;
  for (std::size_t v = 0; v < execution_counts_.size(); ++v) {
    const auto volume = static_cast<VolumeId>(v);
    if (execution_counts_[v] * 10 < static_cast<double>(options.min_steps) || !may_be_tried(volume))
      continue;
    Candidate& candidate = candidates_[volume];
    if (candidate.compile_ms == 0) {
      const ScenePlan plan = plan_scene(shared_->geometry, facts_, volume);
      if (std::string why; !worth_compiling(shared_->geometry, plan, &why)) {
        note(volume, SceneStatus::unprofitable, why);
        continue;
      }
      candidate = {volume, 0, 0, expected_compile_ms(shared_->geometry, plan),
                   expected_gain_ns(plan)};
    }
    if (const double bound = bound_ns(volume); std::isfinite(bound)) {
      candidate.gain_ns = gain_over_data * bound;
    }
    candidate.executions = execution_counts_[v];
    candidate.recent = recent_[v];
    candidates.push_back(candidate);
  }
  const std::vector<VolumeId> module = next_module(candidates, options);
  if (!module.empty()) {
    shared_->log->debug("event=chosen at_s={:.3f} scenes={} first={} candidates={}", seconds(),
                        module.size(), quoted(shared_->geometry.world().volumes[module[0]].name),
                        candidates.size());
  }
  return module;
}

bool Specialiser::may_be_tried(VolumeId volume) {
  const std::lock_guard lock(mutex_);
  const auto known = scenes_.find(volume);
  if (known == scenes_.end()) return true;
  if (known->second.status == SceneStatus::generic) return true;  // bound to data, or to nothing
  if (known->second.status != SceneStatus::unprofitable) return false;
  // What was slower on the states of its time may be faster on those of another phase.
  const auto again = try_again_at_.find(volume);
  return again != try_again_at_.end() && execution_counts_[volume] >= again->second;
}

void Specialiser::note(VolumeId volume, SceneStatus status, const std::string& why) {
  shared_->log->debug("event=status at_s={:.3f} scene={} status={} why={}", seconds(),
                      quoted(shared_->geometry.world().volumes[volume].name), status_name(status),
                      quoted(why));
  const std::lock_guard lock(mutex_);
  for (const VolumeId equal : facts_.equals[volume]) {
    SceneReport& scene = scenes_[equal];
    scene.status = status;
    scene.note = why;
  }
}

void Specialiser::note_failure(VolumeId volume, const std::string& why) {
  const std::lock_guard lock(mutex_);
  shared_->log->warn("scene {} stays {}: {}", shared_->geometry.world().volumes[volume].name,
                     scenes_[volume].binding == Binding::data ? "bound to data" : "generic",
                     one_line(why));
  scenes_[volume].status = SceneStatus::failed;
  scenes_[volume].note = why;
}

std::vector<VolumeId> Specialiser::worth_trying(const std::vector<VolumeId>& batch) {
  std::vector<VolumeId> worth;
  for (const VolumeId volume : batch) {
    std::string why;
    const ScenePlan plan = plan_scene(shared_->geometry, facts_, volume);
    if (worth_compiling(shared_->geometry, plan, &why)) {
      note(volume, SceneStatus::compiling, "");
      worth.push_back(volume);
    } else {
      note(volume, SceneStatus::unprofitable, why);
    }
  }
  return worth;
}

void Specialiser::specialise(const std::vector<VolumeId>& batch) {
  const std::vector<VolumeId> worth = worth_trying(batch);
  if (worth.empty()) return;
  if (make_module(worth)) remember(worth);
}

void Specialiser::specialise_all() {
  for (std::size_t v = 0; v < facts_.reachable.size() && !stopping(); ++v) {
    if (facts_.reachable[v]) bind_to_data(static_cast<VolumeId>(v));
  }
  if (!maker_ || !shared_->options.specialiser.constants) return;
  std::vector<VolumeId> batch;
  const auto flush = [&] {
    if (!batch.empty()) specialise(batch);
    batch.clear();
  };
  // Nothing is known of what will be hot: what occurs most often is the best guess.
  std::vector<VolumeId> volumes;
  for (std::size_t v = 0; v < facts_.reachable.size(); ++v) {
    const auto volume = static_cast<VolumeId>(v);
    if (facts_.reachable[v] && facts_.first_equal[v] == v && may_be_tried(volume)) {
      volumes.push_back(volume);
    }
  }
  std::stable_sort(volumes.begin(), volumes.end(), [&](VolumeId a, VolumeId b) {
    return facts_.touchables[a] > facts_.touchables[b];
  });
  double expected = 0;
  for (const VolumeId volume : volumes) {
    expected +=
        expected_compile_ms(shared_->geometry, plan_scene(shared_->geometry, facts_, volume));
    if (expected > shared_->options.specialiser.wait_ms) break;
    batch.push_back(volume);
    if (batch.size() == shared_->options.specialiser.batch) flush();
    if (hopeless_ || stopping()) return;
  }
  flush();
}

void Specialiser::time_generic(double most_seconds) {
  gather();
  std::vector<VolumeId> hottest;
  for (std::size_t v = 0; v < steps_.size(); ++v) {
    if (steps_[v] > 0) hottest.push_back(static_cast<VolumeId>(v));
  }
  std::stable_sort(hottest.begin(), hottest.end(),
                   [&](VolumeId a, VolumeId b) { return steps_[a] > steps_[b]; });
  double until = now() + most_seconds;
  for (const VolumeId volume : hottest) {
    const std::string structure = plan_scene(shared_->geometry, facts_, volume).pattern;
    const std::lock_guard lock(mutex_);
    scenes_[volume].structure = structure;
    if (now() > until) break;
  }
  until = now() + std::min(std::max(0.1 * seconds(), 0.02), most_seconds);
  for (const VolumeId volume : hottest) {
    {
      const std::lock_guard lock(mutex_);
      if (scenes_[volume].generic_ns_per_step > 0) continue;
    }
    const std::vector<Sample>& samples = samples_[volume];
    if (samples.empty()) continue;
    const double ns = time_per_step(shared_->geometry, shared_->table.context(),
                                    generic::dispatch_entry, samples);
    const std::lock_guard lock(mutex_);
    scenes_[volume].generic_ns_per_step = ns;
    if (now() > until) return;
  }
}

StepProfile Specialiser::step_profile() {
  gather();
  StepProfile profile;
  profile.geometry = geometry_fingerprint(shared_->geometry);
  profile.runs = 1;
  // Samples are a part of the steps, and dropped where nobody takes them: scaled to all steps.
  const World& world = shared_->geometry.world();
  std::uint64_t steps = 0, sampled = 0;
  for (std::size_t v = 0; v < steps_.size(); ++v) {
    steps += v == world.top ? 0 : steps_[v];
    sampled += steps_below_[v];
  }
  const double scale =
      sampled > 0 ? static_cast<double>(steps) / static_cast<double>(sampled) : 0.0;
  for (std::size_t v = 0; v < steps_.size(); ++v) {
    const auto relocations =
        static_cast<std::uint64_t>(scale * static_cast<double>(steps_below_[v]));
    if (steps_[v] + relocations == 0) continue;
    profile.volumes.push_back(
        {static_cast<VolumeId>(v), world.volumes[v].name, steps_[v], relocations});
  }
  return profile;
}

std::size_t Specialiser::specialised() const {
  const std::lock_guard lock(mutex_);
  return static_cast<std::size_t>(std::count_if(scenes_.begin(), scenes_.end(), [](const auto& s) {
    return s.second.binding != Binding::generic;
  }));
}

RuntimeReport Specialiser::report() const {
  const detail::Counts counts = shared_->counts();
  const std::lock_guard lock(mutex_);
  RuntimeReport report = totals_;
  report.seconds = seconds();
  const World& world = shared_->geometry.world();
  for (std::size_t v = 0; v < world.volumes.size(); ++v) {
    const auto volume = static_cast<VolumeId>(v);
    SceneReport scene;
    if (const auto known = scenes_.find(volume); known != scenes_.end()) scene = known->second;
    scene.steps = counts.steps(volume);
    if (scene.steps == 0) continue;
    scene.volume_id = volume;
    scene.volume = world.volumes[v].name;
    report.steps += scene.steps;
    report.scenes.push_back(std::move(scene));
  }
  for (SceneReport& scene : report.scenes) {
    scene.share = static_cast<double>(scene.steps) / static_cast<double>(report.steps);
  }
  std::stable_sort(report.scenes.begin(), report.scenes.end(),
                   [](const auto& a, const auto& b) { return a.steps > b.steps; });
  return report;
}

}  // namespace navjit
