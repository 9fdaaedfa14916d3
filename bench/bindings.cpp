// What each binding of the scene template gains, on many detectors: the generic navigator, then
// scenes bound to data, also to structures, and the hottest also to constants; straight rays and
// particles that scatter. All in one process, on the same rays, in turn, by processor time.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>

#include "bench/cells.hpp"
#include "bench/ranges.hpp"
#include "bench/ray_options.hpp"
#include "bench/warm_up.hpp"
#include "common/clock.hpp"
#include "common/statistics.hpp"
#include "geometry/gdml/read_world.hpp"
#include "geometry/model/random.hpp"
#include "navjit/runtime.hpp"
#include "runtime/transport.hpp"

namespace {

using namespace navjit;

struct Work {
  std::uint64_t steps = 0;
  double length = 0;
};

Work straight(Navigator& navigator, const World& world, const std::vector<Ray>& rays) {
  Work work;
  for (const Ray& ray : rays) {
    const RayTotals t = transport(navigator, ray, world.tolerance);
    work.steps += t.steps;
    work.length += t.length;
  }
  return work;
}

/// Random numbers, drawn beforehand: to draw them would cost as much as the steps.
struct Draw {
  double path;  ///< exponential, mean 1
  Vec3 kick;    ///< change of the direction
};

std::vector<Draw> draws() {
  std::mt19937_64 random(7);
  std::vector<Draw> all(4093);
  for (Draw& d : all) {
    d.path = -std::log(1 - uniform(random, 0, 1));
    const double spread = uniform(random, 0, 1) < 0.05 ? 100 : 0.1;
    d.kick = spread * uniform(random, 0, 1) * unit_vector(random);
  }
  return all;
}

/// A particle as physics would move it: steps of exponential length about `mean_path`, after which
/// its direction changes by some 0.1 rad, or one time in twenty to any direction. The safety is
/// asked before each step, as multiple scattering does. At most `most_steps` steps.
Work scattering(Navigator& navigator, const std::vector<Ray>& rays, double mean_path,
                int most_steps) {
  static const std::vector<Draw> chance = draws();
  Work work;
  std::size_t at = 0;
  for (const Ray& ray : rays) {
    Vec3 p = ray.position, v = ray.direction;
    State state = navigator.locate(p, v);
    for (int n = 0; n < most_steps && state.inside(); ++n) {
      const double safety = navigator.safety(state, p);
      const Draw& draw = chance[at++ % chance.size()];
      const double limit = mean_path * draw.path;
      const Step step = navigator.step(state, p, v, limit);
      p += step.length * v;
      ++work.steps;
      work.length += step.length + 1e-3 * safety;
      state = step.next;
      if (step.boundary) continue;
      v += draw.kick;
      v = (1 / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z)) * v;
    }
  }
  return work;
}

struct Engine {
  std::unique_ptr<Runtime> runtime;
  Navigator navigator;
  std::vector<double> ns[2]{};  ///< for the work done once, by kind and repetition
  Work work[2]{};

  Engine(const std::shared_ptr<const World>& world, const RuntimeOptions& options)
      : runtime(std::make_unique<Runtime>(world, options)), navigator(runtime->navigator()) {}
};

/// By kind of work and binding, of all detectors; unmeasured where no step is made.
struct Gains {
  std::vector<double> of[2][3];
};

void measure(const std::string& file, const bench::RayOptions& options, int repetitions,
             bool constants, bool log, bool judged, Gains& gains) {
  const auto world = std::make_shared<const World>(read_world(file));
  const std::vector<Ray> rays = bench::rays_of_any(options, *world);
  std::vector<std::unique_ptr<Engine>> engines;
  for (int binding = 0; binding < (constants ? 4 : 2); ++binding) {
    RuntimeOptions o;
    o.jit = binding == 0 ? JitMode::off : JitMode::on;
    o.specialiser.structures = binding >= 2;
    o.specialiser.constants = binding == 3;
    o.specialiser.solids = binding >= 2;
    o.specialiser.keep_only_faster = judged;
    if (log) {
      o.log = [](LogLevel, std::string_view line) {
        std::fprintf(stderr, "%.*s\n", static_cast<int>(line.size()), line.data());
      };
    }
    engines.push_back(std::make_unique<Engine>(world, o));
  }
  const Work once = straight(engines[0]->navigator, *world, rays);
  const double path = once.length / static_cast<double>(std::max<std::uint64_t>(once.steps, 1));
  const auto run = [&](Engine& engine, int kind) {
    return kind == 0 ? straight(engine.navigator, *world, rays)
                     : scattering(engine.navigator, rays, path, 60);
  };
  for (auto& engine : engines) {
    if (engine == engines[0]) continue;
    bench::warm_up(*engine->runtime, 5, [&] {
      run(*engine, 0);
      run(*engine, 1);
    });
  }
  for (int r = 0; r < repetitions; ++r) {
    for (std::size_t turn = 0; turn < engines.size(); ++turn) {
      // The order changes, since an engine leaves the caches filled with its own data.
      Engine& engine = *engines[r % 2 == 0 ? turn : engines.size() - 1 - turn];
      for (int kind : {0, 1}) {
        // This is long compared with the trials that the runtime now and then makes of scenes.
        const double start = common::thread_ns();
        double took = 0;
        int times = 0;
        for (; took < 1e8; ++times) {
          engine.work[kind] = run(engine, kind);
          took = common::thread_ns() - start;
        }
        engine.ns[kind].push_back(took / times);
      }
    }
  }
  std::printf("%-30.30s", std::filesystem::path(file).stem().c_str());
  for (int kind : {0, 1}) {
    const auto per_step = [&](const Engine& e) {
      return bench::each(common::summarise(e.ns[kind]).median, e.work[kind].steps);
    };
    std::printf(" | %7s", bench::cell(per_step(*engines[0]), 1).c_str());
    for (std::size_t e = 1; e < engines.size(); ++e) {
      const double gain = engines[0]->work[kind].steps > 0
                              ? common::ratio(engines[0]->ns[kind], engines[e]->ns[kind]).median
                              : bench::unmeasured;
      std::printf(" %5s", bench::cell(gain, 2).c_str());
      gains.of[kind][e - 1].push_back(gain);
      if (engines[e]->work[kind].length != engines[0]->work[kind].length) {
        std::printf(" DIFFERS");
      }
    }
  }
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app{"What each binding brings over the generic navigator, on many detectors"};
  std::vector<std::string> detectors;
  bench::RayOptions options;
  options.count = 20000;
  options.aim = "auto";
  int repetitions = 7;
  bool constants = true, log = false, judged = true;
  app.add_option("detectors", detectors, "GDML files")->required();
  bench::add_ray_options(app, options);
  app.add_option("--repetitions", repetitions, "of each engine, in turn")
      ->check(bench::range_of_repetitions());
  app.add_flag("!--without-constants", constants, "scenes are bound to data alone");
  app.add_flag("!--unjudged", judged, "what is slower in the run stays, too");
  app.add_flag("--log", log, "what is bound, compiled and judged, on the standard error");
  CLI11_PARSE(app, argc, argv);
  std::printf(
      "%-30s | straight: ns/step, speed-up by data, structures, constants | scattering: the same\n",
      "detector");
  Gains gains;
  for (const std::string& detector : detectors) {
    measure(detector, options, repetitions, constants, log, judged, gains);
  }
  for (const char* what : {"mean", "worst"}) {
    std::printf("%-30s", what);
    for (int kind : {0, 1}) {
      std::printf(" | %7s", "");
      for (int e = 0; e < (constants ? 3 : 1); ++e) {
        const std::vector<double>& all = gains.of[kind][e];
        const double figure = what[0] == 'm' ? bench::mean_of(all) : bench::worst_of(all);
        std::printf(" %5s", bench::cell(figure, 2).c_str());
      }
    }
    std::printf("\n");
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "bindings: %s\n", error.what());
  return 1;
}
