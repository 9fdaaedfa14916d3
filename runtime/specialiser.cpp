#include "runtime/specialiser.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

#include "analysis/plan.hpp"
#include "codegen/module.hpp"
#include "geometry/navigation/generic.hpp"
#include "jit/compiler.hpp"
#include "jit/linker.hpp"
#include "runtime/overrides.hpp"
#include "runtime/verify.hpp"

namespace navjit {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t samples_kept = 512;    ///< per volume
constexpr std::size_t states_made_up = 400;  ///< per volume, for verification

double now() { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); }

/// A module's code, and the records that point into it.
struct Installed {
  jit::Code code;
  std::vector<kernels::Navigators> records;
};

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

struct Specialiser::Compiler {
  jit::Compiler compiler;
  jit::Linker linker;
};

namespace {

/// The processor's name for the compiler; empty for this machine's own.
const char* processor(InstructionSet set) {
#if defined(__x86_64__)
  switch (set) {
    case InstructionSet::native:
      break;
    case InstructionSet::sse42:
      if (__builtin_cpu_supports("x86-64-v2")) return "x86-64-v2";
      break;
    case InstructionSet::avx2:
      if (__builtin_cpu_supports("x86-64-v3")) return "x86-64-v3";
      break;
    case InstructionSet::avx512:
      if (__builtin_cpu_supports("x86-64-v4")) return "x86-64-v4";
  }
#endif
  if (set != InstructionSet::native) {
    spdlog::warn("this processor has not the instructions asked for: generated code uses its own");
  }
  return "";
}

}  // namespace

Specialiser::Specialiser(std::shared_ptr<detail::Shared> shared)
    : shared_(std::move(shared)),
      facts_(analyse_world(shared_->geometry)),
      sampler_(shared_->geometry),
      steps_(shared_->geometry.size(), 0),
      steps_below_(shared_->geometry.size(), 0),
      started_at_(now()) {
  if (shared_->options.jit == JitMode::off) return;
  apply_overrides();
  const SpecialiserOptions& options = shared_->options.specialiser;
  jit::CompileOptions compile_options;
  compile_options.optimisation = options.optimisation;
  compile_options.debug_info = options.debug_info;
  compile_options.cpu = processor(options.instruction_set);
  auto compiler = jit::Compiler::create(compile_options);
  auto linker = jit::Linker::create({true, options.perf_map});
  if (!compiler || !linker) {
    spdlog::warn("no specialisation in this run: {}",
                 (!compiler ? compiler.failure() : linker.failure()).message);
    return;
  }
  compiler_ = std::make_unique<Compiler>(Compiler{std::move(*compiler), std::move(*linker)});
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
  if (compiler_) thread_ = std::thread([this] { run(); });
}

void Specialiser::run() {
  std::unique_lock lock(mutex_);
  while (!stop_) {
    lock.unlock();
    gather();
    const std::vector<VolumeId> batch = choose();
    if (!batch.empty()) specialise(batch);
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

void Specialiser::specialise(const std::vector<VolumeId>& batch) {
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
  if (!worth.empty()) compile_module(worth);
}

void Specialiser::compile_module(const std::vector<VolumeId>& batch) {
  const double start = now();
  const Geometry& geometry = shared_->geometry;
  codegen::Module module = codegen::generate(geometry, facts_, batch);
  if (shared_->options.faults.edit_source) shared_->options.faults.edit_source(module.source);
  auto object = compiler_->compiler.compile(module.source, "navjit_module");
  auto code = object ? compiler_->linker.link(*object) : jit::Expected<jit::Code>(object.failure());
  if (!code) {
    if (batch.size() > 1) {
      // One scene may have spoilt the module for all.
      for (const VolumeId volume : batch) compile_module({volume});
      return;
    }
    spdlog::warn("scene {} stays generic: {}", geometry.world().volumes[batch[0]].name,
                 code.failure().message);
    note(batch[0], SceneStatus::failed, code.failure().message);
    return;
  }
  const double compile_ms = (now() - start) * 1e3;
  spdlog::debug(
      "module of {} scenes: {} kB of source; front end {:.0f}, optimiser {:.0f}, code "
      "generator {:.0f} ms; {} kB of code",
      batch.size(), module.source.size() / 1024, object->report.frontend_ms,
      object->report.optimise_ms, object->report.codegen_ms, object->report.code_bytes / 1024);
  auto installed = std::make_shared<Installed>(Installed{std::move(*code), {}});
  installed->records.reserve(module.entries.size());  // pointers to records are published
  for (const codegen::Entry& entry : module.entries) {
    const auto step =
        installed->code.function<std::remove_pointer_t<kernels::StepFunction>>(entry.step);
    const auto settle =
        installed->code.function<std::remove_pointer_t<kernels::SettleFunction>>(entry.settle);
    if (!step || !settle) {
      note_failure(entry.volume, "the generated function is missing");
      continue;
    }
    const kernels::Navigators& record =
        installed->records.emplace_back(kernels::Navigators{*step, *settle});
    std::vector<Sample> samples = samples_[entry.volume];
    const std::vector<Sample> made_up =
        sampler_.states(entry.volume, states_made_up, entry.volume + 1);
    const std::size_t recorded = samples.size();
    samples.insert(samples.end(), made_up.begin(), made_up.end());
    const kernels::Context& context = shared_->table.context();
    std::string problem = verify(geometry, context, record, entry.volume, samples);
    if (shared_->options.faults.fail_verification) problem = "injected failure";
    const std::string& name = geometry.world().volumes[entry.volume].name;
    if (!problem.empty()) {
      note_failure(entry.volume, problem);
      continue;
    }
    const std::span<const Sample> timed =
        recorded > 0 ? std::span(samples).first(recorded) : std::span<const Sample>(samples);
    const double generic_ns = time_per_step(geometry, context, generic::navigators, timed);
    const double specialised_ns = time_per_step(geometry, context, record, timed);
    const bool forced = facts_.forced_candidates.contains(facts_.first_equal[entry.volume]) ||
                        !shared_->options.specialiser.keep_only_faster;
    const bool pays = forced || specialised_ns <= generic_ns || timed.size() < 16;
    if (pays) shared_->table.install(entry.volume, &record, installed);
    spdlog::debug("scene {}: {:.1f} ns generic, {:.1f} ns specialised{}", name, generic_ns,
                  specialised_ns, pays ? "" : ": not installed");
    const std::lock_guard lock(mutex_);
    SceneReport& scene = scenes_[entry.volume];
    scene.status = pays ? SceneStatus::specialised : SceneStatus::unprofitable;
    scene.note = pays ? "" : "measured slower than the generic navigator";
    scene.generic_ns_per_step = generic_ns;
    scene.specialised_ns_per_step = specialised_ns;
    scene.compile_ms = compile_ms / static_cast<double>(module.entries.size());
    scene.swapped_at_s = pays ? seconds() : 0;
  }
  const std::lock_guard lock(mutex_);
  ++totals_.modules;
  totals_.compile_ms += (now() - start) * 1e3;
  totals_.code_bytes += object->report.code_bytes;
}

void Specialiser::specialise_all() {
  if (!compiler_) return;
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

RuntimeReport Specialiser::report() const {
  std::vector<std::shared_ptr<Profile>> profiles;
  {
    const std::lock_guard lock(shared_->profiles_mutex);
    profiles = shared_->profiles;
  }
  const std::lock_guard lock(mutex_);
  RuntimeReport report = totals_;
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
