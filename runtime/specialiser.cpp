#include "runtime/specialiser.hpp"

#include <spdlog/spdlog.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <new>
#include <utility>

#include "analysis/plan.hpp"
#include "jit/activity.hpp"
#include "runtime/bind_to_data.hpp"
#include "runtime/bind_to_structure.hpp"
#include "runtime/choose.hpp"
#include "runtime/compile_next.hpp"
#include "runtime/compile_solids.hpp"
#include "runtime/gather.hpp"
#include "runtime/judge.hpp"
#include "runtime/own_thread.hpp"
#include "runtime/processor_time.hpp"
#include "runtime/remembered_modules.hpp"
#include "runtime/reports.hpp"
#include "runtime/watch.hpp"

namespace navjit {

Specialiser::Specialiser(std::shared_ptr<detail::Shared> shared)
    : spec_(std::move(shared)),
      over_fork_({&spec_.mutex, &spec_.shared->mutex(), &spec_.shared->table.mutex()}) {
  const RuntimeOptions& options = spec_.shared->options;
  spec_.shared->table.keep(spec_.arena);
  spec_.facts.with_safety = options.specialiser.safety;
  apply_overrides(spec_);  // before a plugin is installed, since these also apply to its scenes
  if (options.jit == JitMode::off) return;
  if (!jit::has_compiler()) return;
  spec_.maker = std::make_shared<CodeMaker>(options.specialiser, options.cache, spec_.shared->log);
}

bool Specialiser::stop() {
  if (was_forked()) {
    // There is nothing to join or to detach, so what remains of the thread is kept as it is.
    if (left_behind_ == nullptr) left_behind_ = new std::thread(std::move(thread_));
  }
  if (left_behind_ != nullptr) return false;
  std::unique_lock lock(spec_.mutex);
  spec_.stop.request_stop();
  spec_.wake.notify_all();
  if (!thread_.joinable()) return true;
  // The thread ends at once, since nobody waits for a compilation that is under way.
  spec_.wake.wait(lock, [&] { return ended_; });
  // Runtimes are also destroyed when memory is exhausted. Then a report may lack a note, and exit()
  // waits only if it was told to before.
  try {
    for (auto& [volume, scene] : spec_.scenes) {
      if (scene.status != SceneStatus::compiling) continue;
      scene.status = SceneStatus::generic;
      scene.note = "the run ended before it was compiled";
    }
  } catch (const std::bad_alloc&) {
  }
  lock.unlock();
  thread_.join();
  try {
    if (jit::Activity::any()) jit::outlast_activities();
  } catch (const std::bad_alloc&) {
  }
  return true;
}

StepProfile Specialiser::step_profile() {
  if (!thread_.joinable() && left_behind_ == nullptr) gather(spec_);
  return navjit::step_profile(spec_);
}

void Specialiser::start() {
  spec_.hopeless = !spec_.maker;
  try {
    thread_ = own_thread([activity = std::make_unique<jit::Activity>(spec_.stop),
                          self = shared_from_this()]() mutable {
      // The order matters: the activity must end last, because the last owner of the specialiser
      // destroys the compiler with it.
      const std::unique_ptr<jit::Activity> until_the_end = std::move(activity);
      const std::shared_ptr<Specialiser> own = std::move(self);
      own->run();
    });
  } catch (const std::exception& error) {
    spec_.hopeless = true;
    spec_.shared->log->warn("nothing is specialised in this run: no thread for it: {}",
                            error.what());
  }
}

void Specialiser::run() {
  // This is for this thread and for those that it makes for the compiler.
  // A program that was started with a lower priority keeps it.
  setpriority(PRIO_PROCESS, 0,
              std::max(getpriority(PRIO_PROCESS, 0), spec_.shared->options.specialiser.nice));
  try {
    look_until_stopped();
  } catch (const std::exception& error) {
    if (!spec_.stopping())
      spec_.shared->log->warn("nothing more is specialised in this run: {}", error.what());
  }
  try {
    judge_finally(spec_);
  } catch (const std::exception& error) {
    // All installed navigators stay, since they were verified.
    spec_.shared->log->warn("trials stay undecided at the end of this run: {}", error.what());
  }
  const std::lock_guard lock(spec_.mutex);
  ended_ = true;
  spec_.wake.notify_all();
}

void Specialiser::look_until_stopped() {
  if (spec_.maker) install_remembered(spec_);
  spec_.looking = true;
  std::unique_lock lock(spec_.mutex);
  while (!spec_.stopping()) {
    lock.unlock();
    const double began_s = thread_seconds();
    gather(spec_);
    const bool more_to_bind = bind_hot_to_data(spec_);
    const bool compiled = !more_to_bind && compile_next(spec_);
    if (spec_.stopping()) return;
    // The time that compiling took is not part of any stretch of a trial.
    if (compiled) spec_.looked_at = spec_.seconds();
    watch(spec_);
    if (!compiled) judge(spec_);
    const std::size_t waiting = spec_.shared->table.reclaim();
    lock.lock();
    spec_.totals.waiting_to_be_freed = waiting;
    ++looks_;
    const bool idle = !more_to_bind && !compiled;
    if (idle) idle_look_ = looks_;
    spec_.wake.notify_all();
    if (!idle) {
      spec_.pace.quiet = 1;
      continue;
    }
    const bool trying = spec_.trials.open() || spec_.group.open();
    const double pause = pause_after(spec_.pace, {.took_s = thread_seconds() - began_s,
                                                  .navigated_s = spec_.navigated_s(),
                                                  .is_quiet = !trying,
                                                  .is_idle = !spec_.active,
                                                  .poll_s = 1e-3 * spec_.poll_ms()});
    // Any notification ends the pause, and so does a request to stop, as at the end of the process.
    constexpr double most_ms = 5;  // while somebody waits for the looks
    const std::chrono::duration<double, std::milli> ms(
        waiting_for_idle_ == 0 ? pause * spec_.poll_ms() : std::min(spec_.poll_ms(), most_ms));
    spec_.wake.wait_for(lock, spec_.stop.get_token(), ms,
                        [woken = false]() mutable { return std::exchange(woken, true); });
  }
}

void Specialiser::wait_until_idle() {
  if (!thread_.joinable() || was_forked()) return;
  std::unique_lock lock(spec_.mutex);
  ++waiting_for_idle_;
  spec_.wake.notify_all();
  // The look that is under way may have begun before this call, but the next one sees all counts of
  // now. What is due by these counts is done before a look finds nothing to do.
  spec_.wake.wait(lock, [&, target = looks_ + 2] {
    return ended_ || spec_.stopping() || idle_look_ >= target;
  });
  --waiting_for_idle_;
}

void Specialiser::specialise_all() {
  bind_all_to_data(spec_);
  if (!spec_.maker) return;
  const double started = spec_.own_seconds();
  const double wait_ms = spec_.shared->options.specialiser.wait_ms;
  const auto spent_ms = [&] { return 1e3 * (spec_.own_seconds() - started); };
  std::set<VolumeId> compiled;  // or tried
  const auto compile_solids_of_others = [&] {
    compile_solids_of_all(spec_, compiled, wait_ms - spent_ms());
    if (!spec_.stopping()) bind_all_to_data(spec_);
  };
  if (!spec_.shared->options.specialiser.constants) {
    compile_solids_of_others();
    // Structures are compiled only here: otherwise constants would replace them anyway.
    while (spent_ms() < wait_ms) {
      const std::optional<DueStructure> structure = any_structure(spec_);
      if (!structure || !bind_to_structure(spec_, *structure)) break;
    }
    return;
  }
  std::vector<VolumeId> batch;
  const auto flush = [&] {
    if (!batch.empty()) make_and_remember(spec_, batch);
    batch.clear();
  };
  // It is not known what will be hot. What occurs most often is the best guess.
  std::vector<VolumeId> volumes;
  for (std::size_t v = 0; v < spec_.facts.reachable.size(); ++v) {
    const auto volume = static_cast<VolumeId>(v);
    if (spec_.facts.reachable[v] && spec_.facts.first_equal[v] == v &&
        may_be_tried(spec_, volume)) {
      volumes.push_back(volume);
    }
  }
  std::vector<TouchableId> touchables(spec_.facts.touchables.size(), 0);
  for (std::size_t v = 0; v < touchables.size(); ++v) {
    touchables[spec_.facts.first_equal[v]] += spec_.facts.touchables[v];
  }
  std::stable_sort(volumes.begin(), volumes.end(),
                   [&](VolumeId a, VolumeId b) { return touchables[a] > touchables[b]; });
  const SpecialiserOptions& options = spec_.shared->options.specialiser;
  double expected = 0, of_module = module_base_ms;
  for (const VolumeId volume : volumes) {
    const ScenePlan plan = plan_scene(spec_.shared->geometry, spec_.facts, volume);
    const double ms = expected_compile_ms(spec_.shared->geometry, plan);
    if (ms > most_scene_ms || !worth_compiling(spec_.shared->geometry, plan)) continue;
    // On a slow machine a larger module might exceed the limit for modules, and be given up.
    if (batch.size() == options.batch || (!batch.empty() && of_module + ms > options.module_ms)) {
      flush();
      of_module = module_base_ms;
    }
    if (spec_.hopeless || spec_.stopping()) return;
    expected += ms;
    of_module += ms;
    if (std::max(expected, spent_ms()) > wait_ms) break;
    batch.push_back(volume);
    compiled.insert(spec_.facts.equals[volume].begin(), spec_.facts.equals[volume].end());
  }
  flush();
  compile_solids_of_others();
}

}  // namespace navjit
