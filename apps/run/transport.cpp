#include "apps/run/transport.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <mutex>
#include <new>
#include <optional>
#include <system_error>
#include <thread>

#include "apps/run/progress.hpp"
#include "apps/run/ray_maker.hpp"
#include "common/interruption.hpp"
#include "common/ordered_chunks.hpp"
#include "common/parallel.hpp"
#include "common/progress_line.hpp"
#include "runtime/processor_time.hpp"

namespace navjit::apps {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Rays that a thread takes at a time. Sums are made per chunk and added in order, so that they do
/// not depend on the number of threads.
constexpr std::size_t rays_per_chunk = 64;
/// Chunks that may be under way for each thread.
constexpr std::uint64_t chunks_per_thread = 64;

struct ChunkTotals {
  std::uint64_t rays = 0, steps = 0, stuck = 0, outside = 0;
  double length = 0;
};

/// Chunks in a piece of work: with a basket enough that it is mostly full.
std::size_t chunks_in_piece(std::size_t basket) {
  return std::max<std::size_t>(1, 4 * basket / rays_per_chunk);
}

std::vector<ChunkTotals> by_chunk(const std::vector<RayTotals>& rays) {
  std::vector<ChunkTotals> chunks(1);
  for (const RayTotals& ray : rays) {
    if (chunks.back().rays == rays_per_chunk) chunks.emplace_back();
    ChunkTotals& chunk = chunks.back();
    ++chunk.rays;
    chunk.steps += ray.steps;
    chunk.length += ray.length;
    chunk.stuck += ray.stuck ? 1 : 0;
    chunk.outside += ray.steps == 0 && !ray.stuck ? 1 : 0;
  }
  return chunks;
}

/// Counters that are read while threads work.
struct Progress {
  std::atomic<std::uint64_t> rays{0};
  std::atomic<std::uint64_t> steps{0};
};

/// Looks at a run a hundred times a second until it is done: the progress line, and how many steps
/// there were when.
class Watch {
 public:
  Watch(const Runtime& runtime, const Progress& progress, std::uint64_t rays,
        Clock::time_point start)
      : runtime_(runtime), progress_(progress), rays_(rays), start_(start) {
    try {
      thread_ = std::jthread([this](const std::stop_token& stop) {
        const double begun = thread_seconds();
        while (!stop.stop_requested()) {
          std::this_thread::sleep_for(std::chrono::milliseconds(10));
          look();
        }
        if (shown_s_ > 0) std::fputs("\r\033[K", stderr);
        processor_s = thread_seconds() - begun;
      });
    } catch (const std::system_error& error) {  // then nobody watches
      spdlog::debug("event=unwatched reason={}", error.what());
    }
  }
  /// Then the figures may be read.
  void end() {
    thread_.request_stop();
    if (thread_.joinable()) thread_.join();
  }

  /// Steps so far: at every look or, in long runs, at every second, fourth, ... one.
  std::vector<std::pair<double, std::uint64_t>> series{};
  double processor_s = 0;

 private:
  void record(double t, std::uint64_t steps) {
    constexpr std::size_t most = 2048;
    if (++looks_ % every_ != 0) return;
    if (series.size() == most) {
      for (std::size_t i = 0; i < most / 2; ++i) series[i] = series[2 * i + 1];
      series.resize(most / 2);
      every_ *= 2;
      return;
    }
    series.emplace_back(t, steps);
  }
  void look() {
    const double t = seconds_since(start_);
    const std::uint64_t steps = progress_.steps.load();
    record(t, steps);
    const std::size_t columns = common::terminal_columns();
    if (columns == 0 || t - shown_s_ < 0.2) return;
    RunProgress progress{t, progress_.rays.load(), rays_,
                         static_cast<double>(steps - shown_steps_) / (t - shown_s_)};
    try {
      for (const SceneReport& scene : runtime_.report().scenes) {
        progress.hot += scene.share >= 0.01 ? 1 : 0;
        progress.compiling += scene.status == SceneStatus::compiling ? 1 : 0;
        progress.swapped += scene.binding != Binding::generic ? 1 : 0;
      }
      std::fprintf(stderr, "\r\033[K%s", progress_line(progress, columns).c_str());
      std::fflush(stderr);
    } catch (const std::bad_alloc&) {  // nothing depends on the line
      std::fputs("\r\033[K", stderr);
    }
    shown_s_ = t;
    shown_steps_ = steps;
  }

  const Runtime& runtime_;
  const Progress& progress_;
  std::uint64_t rays_;
  Clock::time_point start_;
  double shown_s_ = 0;
  std::uint64_t shown_steps_ = 0;
  std::uint64_t looks_ = 0, every_ = 1;
  std::jthread thread_;  ///< last: it uses all of them
};

/// Steps per second after the last swap of a navigator; of the whole run where hardly anything is
/// left then.
double warm_rate(const Transport& made, const RuntimeReport& report) {
  double last_swap_s = 0;
  for (const SceneReport& scene : report.scenes) {
    if (scene.swapped_at_s > 0)
      last_swap_s = std::max(last_swap_s, scene.swapped_at_s - made.begun_s);
  }
  // The first look at or after it.
  const auto look = std::lower_bound(
      made.series.begin(), made.series.end(), last_swap_s,
      [](const std::pair<double, std::uint64_t>& a, double t) { return a.first < t; });
  const bool from_start = last_swap_s == 0;
  if (!from_start && look != made.series.end()) {
    const double after = made.seconds - look->first;
    if (after > 0.01 && made.steps > look->second) {
      return static_cast<double>(made.steps - look->second) / after;
    }
  }
  return static_cast<double>(made.steps) / made.seconds;
}

}  // namespace

Transport transport_rays(Runtime& runtime, const ObservedDetector& seen, common::RayStream& rays,
                         unsigned threads, std::size_t basket, const std::atomic<bool>& in_vain) {
  const double tolerance = runtime.world().tolerance;
  Transport result;
  result.threads = threads;
  Progress progress;
  common::OrderedChunks<std::vector<Ray>, std::vector<ChunkTotals>> chunks(
      chunks_per_thread * threads,
      [&]() -> std::optional<std::vector<Ray>> {
        std::vector<Ray> next = rays.next(rays_per_chunk * chunks_in_piece(basket));
        if (next.empty()) return std::nullopt;
        if (result.first_rays.size() < rays_kept) {
          result.first_rays.insert(result.first_rays.end(), next.begin(), next.end());
        }
        return next;
      },
      [&](const std::vector<ChunkTotals>& piece) {
        for (const ChunkTotals& chunk : piece) {
          result.rays += chunk.rays;
          result.steps += chunk.steps;
          result.stuck += chunk.stuck;
          result.outside += chunk.outside;
          result.length_mm += chunk.length;
        }
      });
  std::atomic<bool> stop{false};
  std::mutex summing;
  const auto work = [&] {
    // Whoever ends wakes those that wait for work; whoever fails leaves a gap that nobody fills.
    struct AtTheEnd {
      decltype(chunks)& all;
      ~AtTheEnd() { all.stop(); }
    } const at_the_end{chunks};
    const double begun = thread_seconds();
    const auto go_on = [&] { return common::interruption() == 0 && !stop && !in_vain; };
    RayMaker maker(runtime, seen, basket);
    for (bool complete = true; complete;) {
      const auto piece = chunks.take();
      if (!piece) break;
      const std::vector<RayTotals> made = maker.make(piece->work, tolerance, go_on);
      complete = made.size() == piece->work.size();
      std::vector<ChunkTotals> totals = by_chunk(made);
      for (const ChunkTotals& chunk : totals) {
        progress.rays.fetch_add(chunk.rays, std::memory_order_relaxed);
        progress.steps.fetch_add(chunk.steps, std::memory_order_relaxed);
      }
      chunks.give(piece->number, std::move(totals), complete);
    }
    const std::lock_guard lock(summing);
    result.cpu_seconds += thread_seconds() - begun;
    result.differences += maker.counts().differences;
    result.bail_outs += maker.counts().bail_outs;
  };

  result.begun_s = runtime.report().seconds;
  const Clock::time_point start = Clock::now();
  Watch watch(runtime, progress, rays.count(), start);
  common::in_parallel(threads, stop, work);
  result.seconds = seconds_since(start);
  watch.end();
  result.watch_seconds = watch.processor_s;
  result.series = std::move(watch.series);
  result.warm_steps_per_second = warm_rate(result, runtime.report());
  return result;
}

}  // namespace navjit::apps
