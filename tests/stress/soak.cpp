// A long run whose hot regions change. Memory has to stay constant, no ray may get stuck, every
// step has to be that of the generic navigator, and the run must not be slower than with that. Exit
// status 1 if not. Each phase has its own threads, with their own navigators.
#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <numeric>
#include <thread>

#include "common/rays.hpp"
#include "geometry/gdml/read_world.hpp"
#include "navjit/runtime.hpp"
#include "runtime/processor_time.hpp"
#include "tests/stress/memory.hpp"

namespace navjit {
namespace {

struct Options {
  std::string detector;
  double minutes = 10, phase_s = 20;
  unsigned threads = 2;
  double most_growth_mb = 32;  ///< after all phases came once
  double least_ratio = 0.97;   ///< of the generic navigator's time to that of the JIT's, by phase
};

/// Where particles come from in each phase: along z in both directions, from everywhere, and from
/// the corners of the world.
common::RaySource source_of(const World& world, int phase) {
  const Extent& e = world.volumes[world.top].solid.extent;
  common::RaySource source;
  source.seed = 1000 + static_cast<std::uint64_t>(phase);
  switch (phase % 5) {
    case 0:
      source.origin = Vec3{0, 0, 0};
      source.eta = {2.0, 5.0};
      break;
    case 1:
      break;
    case 2:
      source.origin = Vec3{0, 0, 0};
      source.eta = {-1.0, 1.0};
      break;
    case 3:
      source.origin = Vec3{0.9 * e.min.x, 0.9 * e.min.y, 0.9 * e.max.z};
      break;
    default:
      source.origin = Vec3{0.3 * e.max.x, 0.4 * e.min.y, 0.9 * e.min.z};
      source.eta = {0.5, 3.0};
  }
  return source;
}

struct Totals {
  std::uint64_t steps = 0, stuck = 0, differ = 0;
  double with_s = 0, without_s = 0;  ///< processor time of the same rays
};

/// Blocks of rays, with and without specialised navigators in turn.
Totals work(Runtime& runtime, Runtime& generic, const common::RayMaker& rays, double seconds,
            std::atomic<std::uint64_t>& next) {
  using Clock = std::chrono::steady_clock;
  constexpr std::uint64_t block = 32;
  Navigator with = runtime.navigator(), without = generic.navigator();
  const World& world = runtime.world();
  Totals totals;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  const auto timed = [&](Navigator& navigator, std::uint64_t first, double& time) {
    RayTotals sum;
    const double begun = thread_seconds();
    for (std::uint64_t i = first; i < first + block; ++i) {
      const RayTotals ray = transport(navigator, rays.ray(i), world.tolerance);
      sum.steps += ray.steps;
      sum.length += ray.length;
      totals.stuck += ray.stuck ? 1 : 0;
    }
    time += thread_seconds() - begun;
    return sum;
  };
  while (Clock::now() < end) {
    const std::uint64_t n = next.fetch_add(1);
    const RayTotals a = timed(n % 2 == 0 ? with : without, n * block,
                              n % 2 == 0 ? totals.with_s : totals.without_s);
    const RayTotals b = timed(n % 2 == 0 ? without : with, n * block,
                              n % 2 == 0 ? totals.without_s : totals.with_s);
    totals.steps += a.steps;
    totals.differ += a.steps == b.steps && a.length == b.length ? 0 : 1;
  }
  return totals;
}

int run(const Options& options) {
  RuntimeOptions jit, off;
  jit.specialiser.recheck_ms = 200;
  off.jit = JitMode::off;
  Runtime runtime(read_world(options.detector, {}), jit);
  Runtime generic(runtime.share_world(), off);
  const int phases = std::max(2, static_cast<int>(options.minutes * 60 / options.phase_s));
  bool good = true;
  double settled_mb = 0;
  std::uint64_t steps = 0;
  for (int phase = 0; phase < phases; ++phase) {
    const common::RayMaker rays(runtime.world(), source_of(runtime.world(), phase));
    std::atomic<std::uint64_t> next{0};
    std::vector<Totals> totals(options.threads);
    {
      std::vector<std::jthread> threads;
      for (Totals& mine : totals) {
        threads.emplace_back([&] { mine = work(runtime, generic, rays, options.phase_s, next); });
      }
    }
    Totals sum;
    for (const Totals& t : totals) {
      sum.steps += t.steps;
      sum.stuck += t.stuck;
      sum.differ += t.differ;
      sum.with_s += t.with_s;
      sum.without_s += t.without_s;
    }
    const double mb = tests::resident_mb(), ratio = sum.without_s / sum.with_s;
    const RuntimeReport report = runtime.report();
    std::size_t specialised = 0;
    double share = 0;
    for (const SceneReport& scene : report.scenes) {
      if (scene.status != SceneStatus::specialised) continue;
      ++specialised;
      share += scene.share;
    }
    std::printf(
        "phase %3d: %9llu steps, %5.1f ns/step, %.2f times generic; %3zu scenes (%2.0f%% of all "
        "steps) of %zu modules, %zu deoptimised, %zu waiting; %.1f MB%s%s\n",
        phase, static_cast<unsigned long long>(sum.steps),
        sum.with_s / static_cast<double>(sum.steps) * 1e9, ratio, specialised, 100 * share,
        report.modules, report.deoptimised, report.waiting_to_be_freed, mb,
        sum.stuck > 0 ? "; STUCK" : "", sum.differ > 0 ? "; DIFFERENT" : "");
    std::fflush(stdout);
    steps += sum.steps;
    good = good && sum.stuck == 0 && sum.differ == 0 && sum.steps > 0;
    if (ratio < options.least_ratio) {
      std::printf("slower than the generic navigator\n");
      good = false;
    }
    if (phase < std::max(5, phases / 2)) {
      settled_mb = std::max(settled_mb, mb);
    } else if (settled_mb > 0 && mb > settled_mb + options.most_growth_mb) {
      std::printf("memory grew\n");
      good = false;
    }
  }
  std::printf("%llu steps with the JIT; %s\n", static_cast<unsigned long long>(steps),
              good ? "all well" : "NOT well");
  return good ? 0 : 1;
}

}  // namespace
}  // namespace navjit

int main(int argc, char** argv) {
  navjit::Options options;
  CLI::App app{"A long run whose hot regions change"};
  app.add_option("detector", options.detector)->required();
  app.add_option("--minutes", options.minutes);
  app.add_option("--phase", options.phase_s, "seconds");
  app.add_option("--threads", options.threads)->check(CLI::Range(1, 1024));
  app.add_option("--most-growth-mb", options.most_growth_mb);
  app.add_option("--least-ratio", options.least_ratio, "0: speed is not judged");
  CLI11_PARSE(app, argc, argv);
  try {
    return navjit::run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "navjit_soak: %s\n", error.what());
    return 1;
  }
}
