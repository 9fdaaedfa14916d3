#include "apps/warmup/one_run.hpp"

#include <time.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "runtime/runtime.hpp"

namespace navjit::warmup {
namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double processor_time(clockid_t clock) {
  timespec t;
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// What one navigating thread tells while it works, and at its end.
struct alignas(64) Worker {
  std::atomic<std::uint64_t> steps{0};
  std::uint64_t rays = 0, stuck = 0;
  double processor_s = 0;
};

struct Shared {
  std::atomic<bool> stop{false};
  std::atomic<std::uint64_t> next_chunk{0};
  std::array<Chunk, chunks_kept> chunks{};
};

void navigate(Runtime& runtime, const common::RaySource& source, Shared& shared, Worker& worker) {
  const double begun = processor_time(CLOCK_THREAD_CPUTIME_ID);
  const World& world = runtime.world();
  Navigator navigator = runtime.navigator();
  std::uint64_t steps = 0;
  while (!shared.stop.load(std::memory_order_relaxed)) {
    const std::uint64_t number = shared.next_chunk.fetch_add(1);
    Chunk chunk;
    bool complete = true;
    for (std::uint64_t i = number * rays_per_chunk; i < (number + 1) * rays_per_chunk; ++i) {
      if (shared.stop.load(std::memory_order_relaxed)) {
        complete = false;
        break;
      }
      const RayTotals ray = transport(navigator, make_ray(source, world, i), world.tolerance);
      chunk.steps += ray.steps;
      chunk.length += ray.length;
      worker.stuck += ray.stuck ? 1 : 0;
      ++worker.rays;
      steps += ray.steps;
      worker.steps.store(steps, std::memory_order_relaxed);
    }
    if (complete && number < chunks_kept) shared.chunks[number] = chunk;
  }
  worker.processor_s = processor_time(CLOCK_THREAD_CPUTIME_ID) - begun;
}

}  // namespace

RunRecord run_once(const RunSetup& setup) {
  GdmlReport known;  // navjit warmup has said it
  const auto world = read(setup.detector, known);
  RunRecord record;
  const double process_begun = processor_time(CLOCK_PROCESS_CPUTIME_ID);
  const double own_begun = processor_time(CLOCK_THREAD_CPUTIME_ID);
  const Clock::time_point start = Clock::now();
  Runtime runtime(world, setup.runtime);
  const double made_own = processor_time(CLOCK_THREAD_CPUTIME_ID) - own_begun;
  // Swaps are told in the runtime's own time.
  const double runtime_begun = since(start) - runtime.report().seconds;
  Shared shared;
  std::vector<Worker> workers(setup.threads);
  std::vector<std::jthread> threads;
  record.series.push_back({0, 0});
  const auto note = [&] {
    double steps = 0;
    for (const Worker& worker : workers) {
      steps += static_cast<double>(worker.steps.load(std::memory_order_relaxed));
    }
    record.series.push_back({since(start), steps});
  };
  note();
  for (Worker& worker : workers) {
    threads.emplace_back([&] { navigate(runtime, setup.source, shared, worker); });
  }
  const auto interval =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(setup.interval));
  for (auto next = Clock::now() + interval; since(start) < setup.seconds; next += interval) {
    std::this_thread::sleep_until(next);
    note();
  }
  shared.stop = true;
  threads.clear();
  note();
  // Making the runtime is work, watching it is not.
  const double watching = processor_time(CLOCK_THREAD_CPUTIME_ID) - own_begun - made_own;
  const double all = processor_time(CLOCK_PROCESS_CPUTIME_ID) - process_begun;
  for (const Worker& worker : workers) {
    record.rays += worker.rays;
    record.steps += worker.steps.load();
    record.stuck += worker.stuck;
    record.navigating_s += worker.processor_s;
  }
  record.other_s = std::max(0.0, all - record.navigating_s - watching);
  record.chunks = shared.chunks;
  const RuntimeReport report = runtime.report();
  for (const SceneReport& scene : report.scenes) {
    if (scene.binding != Binding::generic) {
      record.swaps.push_back({runtime_begun + scene.swapped_at_s, scene.share});
    }
  }
  record.modules = report.modules;
  record.cached_modules = report.cached_modules;
  record.withdrawn = report.withdrawn;
  record.code_bytes = report.code_bytes;
  if (!setup.save_profile.empty()) {
    runtime.final_report();
    write_profile(runtime.step_profile(), setup.save_profile);
  }
  return record;
}

}  // namespace navjit::warmup
