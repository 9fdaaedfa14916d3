#include "runtime/specialiser.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

#include "analysis/plan.hpp"
#include "geometry/navigation/generic.hpp"
#include "runtime/code_maker.hpp"
#include "runtime/fingerprint.hpp"
#include "runtime/overrides.hpp"
#include "runtime/verify.hpp"

namespace navjit {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t samples_kept = 512;  ///< per volume
constexpr std::size_t fresh_kept = 64;     ///< per volume and look

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
      started_at_(now()) {
  if (shared_->options.jit == JitMode::off) return;
  apply_overrides();
  if (!jit::has_compiler()) {
    if (shared_->options.plugin.empty()) {
      spdlog::warn("no specialisation in this run: this program was built without a compiler");
    }
    return;
  }
  maker_ = std::make_unique<CodeMaker>(shared_->options.specialiser, shared_->options.cache);
}

Specialiser::~Specialiser() { stop(); }

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
    } else {
      for (const VolumeId equal : facts_.equals[first]) scenes_.erase(equal);
      facts_.forced_candidates[first] =
          variant == Variant::all ? Candidates::all : Candidates::buckets;
    }
  }
  if (!complaints.empty()) spdlog::warn("{}: {}", overrides_variable, complaints);
}

void Specialiser::stop() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

double Specialiser::seconds() const { return now() - started_at_; }

void Specialiser::start() {
  hopeless_ = !maker_;
  if (maker_ || totals_.plugin_scenes > 0) thread_ = std::thread([this] { run(); });
}

void Specialiser::run() {
  if (maker_) install_remembered();
  std::unique_lock lock(mutex_);
  while (!stop_) {
    lock.unlock();
    gather();
    const std::vector<VolumeId> batch = choose();
    if (!batch.empty()) specialise(batch);
    reconsider();
    shared_->table.sweep();
    lock.lock();
    ++looks_;
    wake_.notify_all();
    if (batch.empty()) {
      wake_.wait_for(
          lock, std::chrono::duration<double, std::milli>(shared_->options.specialiser.poll_ms));
    }
  }
}

void Specialiser::wait_until_idle() {
  if (!thread_.joinable()) return;
  std::unique_lock lock(mutex_);
  // Two looks from now the counts of this moment were seen; compiling may have to follow.
  for (std::uint64_t target = looks_ + 2;;) {
    wake_.wait(lock, [&] { return stop_ || looks_ >= target; });
    const bool busy = std::any_of(scenes_.begin(), scenes_.end(), [](const auto& entry) {
      return entry.second.status == SceneStatus::compiling;
    });
    if (stop_ || !busy) return;
    target = looks_ + 1;
  }
}

void Specialiser::gather() {
  std::vector<std::shared_ptr<Profile>> profiles;
  {
    const std::lock_guard lock(shared_->profiles_mutex);
    profiles = shared_->profiles;
  }
  std::fill(steps_.begin(), steps_.end(), 0);
  for (const auto& profile : profiles) {
    for (std::size_t v = 0; v < steps_.size(); ++v) {
      steps_[v] += profile->steps(static_cast<VolumeId>(v));
    }
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

/// Scenes whose use so far would have paid for compiling them: what was spent is the estimate of
/// what is still to come. Relocation in a mother costs about as much as a step.
std::vector<VolumeId> Specialiser::choose() {
  if (hopeless_) return {};
  const SpecialiserOptions& options = shared_->options.specialiser;
  const double break_even = options.compile_ms_per_scene * 1e6 / options.gain_ns_per_step;
  // Volumes of equal structure are hot together.
  std::vector<std::uint64_t> heats(steps_.size(), 0);
  for (std::size_t v = 0; v < steps_.size(); ++v) {
    heats[facts_.first_equal[v]] += steps_[v] + steps_below_[v];
  }
  const auto heat = [&](VolumeId v) { return heats[v]; };
  std::vector<VolumeId> hot;
  {
    const std::lock_guard lock(mutex_);
    for (std::size_t v = 0; v < steps_.size(); ++v) {
      const auto volume = static_cast<VolumeId>(v);
      if (heat(volume) < options.min_steps || static_cast<double>(heat(volume)) < break_even) {
        continue;
      }
      if (scenes_.contains(volume)) continue;
      hot.push_back(volume);
    }
  }
  std::sort(hot.begin(), hot.end(), [&](VolumeId a, VolumeId b) { return heat(a) > heat(b); });
  if (hot.size() > options.batch) hot.resize(options.batch);
  return hot;
}

void Specialiser::note(VolumeId volume, SceneStatus status, const std::string& why) {
  const std::lock_guard lock(mutex_);
  for (const VolumeId equal : facts_.equals[volume]) {
    SceneReport& scene = scenes_[equal];
    scene.status = status;
    scene.note = why;
  }
}

void Specialiser::note_failure(VolumeId volume, const std::string& why) {
  spdlog::warn("scene {} stays generic: {}", shared_->geometry.world().volumes[volume].name, why);
  const std::lock_guard lock(mutex_);
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
  if (!maker_) return;
  std::vector<VolumeId> batch;
  const auto flush = [&] {
    if (!batch.empty()) specialise(batch);
    batch.clear();
  };
  for (std::size_t v = 0; v < facts_.reachable.size(); ++v) {
    const auto volume = static_cast<VolumeId>(v);
    if (facts_.reachable[v] && facts_.first_equal[v] == v && !scenes_.contains(volume)) {
      batch.push_back(volume);
    }
    if (batch.size() == shared_->options.specialiser.batch) flush();
  }
  flush();
}

void Specialiser::time_generic() {
  gather();
  for (const auto& [volume, samples] : samples_) {
    {
      const std::lock_guard lock(mutex_);
      const auto known = scenes_.find(volume);
      if (known != scenes_.end() && known->second.generic_ns_per_step > 0) continue;
    }
    const double ns =
        time_per_step(shared_->geometry, shared_->table.context(), generic::navigators, samples);
    const std::lock_guard lock(mutex_);
    scenes_[volume].generic_ns_per_step = ns;
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

RuntimeReport Specialiser::report() const {
  std::vector<std::shared_ptr<Profile>> profiles;
  {
    const std::lock_guard lock(shared_->profiles_mutex);
    profiles = shared_->profiles;
  }
  const std::lock_guard lock(mutex_);
  RuntimeReport report = totals_;
  report.seconds = seconds();
  const World& world = shared_->geometry.world();
  for (std::size_t v = 0; v < world.volumes.size(); ++v) {
    const auto volume = static_cast<VolumeId>(v);
    SceneReport scene;
    if (const auto known = scenes_.find(volume); known != scenes_.end()) scene = known->second;
    scene.steps = 0;
    for (const auto& profile : profiles) scene.steps += profile->steps(volume);
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
