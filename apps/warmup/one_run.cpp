#include "apps/warmup/one_run.hpp"

#include <pthread.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "common/parallel.hpp"
#include "navjit/runtime.hpp"
#include "runtime/processor_time.hpp"

namespace navjit::warmup {
namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// What one navigating thread tells while it works, and at its end.
struct alignas(64) Worker {
  std::atomic<std::uint64_t> steps{0};
  std::uint64_t rays = 0, stuck = 0;
  double processor_s = 0;            ///< at its end
  std::atomic<clockid_t> clock{-1};  ///< of its processor time until then; -1 before and after
};

struct Shared {
  std::atomic<bool> stop{false};
  std::atomic<std::uint64_t> next_chunk{0};
  Blocks blocks;
};

void navigate(Runtime& runtime, const common::RayMaker& rays, Shared& shared, Worker& worker) {
  clockid_t clock{};
  if (pthread_getcpuclockid(pthread_self(), &clock) == 0) worker.clock = clock;
  const World& world = runtime.world();
  Navigator navigator = runtime.navigator();
  std::uint64_t steps = 0;
  while (!shared.stop.load(std::memory_order_relaxed)) {
    const std::uint64_t number = shared.next_chunk.fetch_add(1);
    std::uint64_t of_chunk = 0;
    double length = 0;
    bool complete = true;
    for (std::uint64_t i = number * rays_per_chunk; i < (number + 1) * rays_per_chunk; ++i) {
      if (shared.stop.load(std::memory_order_relaxed)) {
        complete = false;
        break;
      }
      const RayTotals ray = transport(navigator, rays.ray(i), world.tolerance);
      of_chunk += ray.steps;
      length += ray.length;
      worker.stuck += ray.stuck ? 1 : 0;
      ++worker.rays;
      steps += ray.steps;
      worker.steps.store(steps, std::memory_order_relaxed);
    }
    if (complete) shared.blocks.add(number, of_chunk, length);
  }
  worker.processor_s = thread_seconds();
  worker.clock = -1;
}

}  // namespace

RunRecord run_once(const RunSetup& setup) {
  GdmlReport known;  // navjit warmup has said it
  const auto world = read(setup.detector, known);
  RunRecord record;
  const double process_begun = process_seconds();
  const double own_begun = thread_seconds();
  const Clock::time_point start = Clock::now();
  Runtime runtime(world, setup.runtime);
  const double made_own = thread_seconds() - own_begun;
  // Swaps are told in the runtime's own time.
  const double runtime_begun = since(start) - runtime.report().seconds;
  Shared shared;
  std::vector<Worker> workers(setup.threads);
  record.series.push_back({});
  const auto note = [&] {
    Point point{since(start)};
    for (const Worker& worker : workers) {
      point.steps += static_cast<double>(worker.steps.load(std::memory_order_relaxed));
      const clockid_t clock = worker.clock.load();
      point.processor_s += clock == -1 ? worker.processor_s : clock_seconds(clock);
    }
    record.series.push_back(point);
  };
  note();
  const common::RayMaker rays(*world, setup.source);
  const auto interval =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(setup.interval));
  std::atomic<std::size_t> next_worker{0};
  const auto watcher = std::this_thread::get_id();
  common::in_parallel(setup.threads + 1, shared.stop, [&] {
    if (std::this_thread::get_id() != watcher) {
      navigate(runtime, rays, shared, workers[next_worker++]);
      return;
    }
    for (auto next = Clock::now() + interval; since(start) < setup.seconds && !shared.stop;
         next += interval) {
      std::this_thread::sleep_until(next);
      note();
    }
    shared.stop = true;
  });
  note();
  // Making the runtime is work, watching it is not.
  const double watching = thread_seconds() - own_begun - made_own;
  const double all = process_seconds() - process_begun;
  for (const Worker& worker : workers) {
    record.rays += worker.rays;
    record.steps += worker.steps.load();
    record.stuck += worker.stuck;
    record.navigating_s += worker.processor_s;
  }
  record.other_s = std::max(0.0, all - record.navigating_s - watching);
  record.blocks = shared.blocks.complete();
  const RuntimeReport report = runtime.report();
  for (const SceneReport& scene : report.scenes) {
    if (scene.specialised_at_s > 0) {
      record.swaps.push_back({runtime_begun + scene.specialised_at_s, scene.share});
    }
  }
  record.modules = report.modules;
  record.cached_modules = report.cached_modules;
  record.deoptimised = report.deoptimised;
  record.code_bytes = report.code_bytes;
  if (!setup.save_profile.empty()) {
    runtime.final_report();
    write_profile(runtime.step_profile(), setup.save_profile);
  }
  return record;
}

}  // namespace navjit::warmup
