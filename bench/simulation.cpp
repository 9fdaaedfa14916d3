// Particles that scatter in matter and have secondaries, with the safety asked before each step:
// navjit's generic and specialised navigators make the same flights in one process, in turn, and so
// does VecGeom's navigator for a single detector, if VecGeom was found.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>

#include "bench/cells.hpp"
#include "bench/choices.hpp"
#include "bench/flights.hpp"
#include "bench/photons.hpp"
#include "bench/ranges.hpp"
#include "bench/ray_options.hpp"
#include "bench/shower.hpp"
#include "bench/warm_up.hpp"
#include "common/clock.hpp"
#include "common/statistics.hpp"
#include "geometry/gdml/read_world.hpp"

namespace {

using namespace navjit;

struct Options {
  bench::RayOptions rays;
  bench::ShowerOptions shower;
  bench::PhotonOptions photons;
  bool only_photons = false;
  int repetitions = 7;
  bench::Asked asked = bench::Asked::whole;
  bool peers = true;
  bool perf_map = false;
};

struct Engine {
  std::string name;
  std::function<void()> prepare;  ///< before each repetition, not timed
  std::function<bench::Followed()> run;
  bench::Followed done{};
  std::vector<double> ns{};  ///< of all flights, by repetition
};

struct Specialised {
  Runtime runtime;
  Navigator navigator;
  Specialised(const std::shared_ptr<const World>& world, JitMode mode, bool perf_map)
      : runtime(world,
                [=] {
                  RuntimeOptions options;
                  options.jit = mode;
                  options.specialiser.perf_map = perf_map;
                  return options;
                }()),
        navigator(runtime.navigator()) {}
};

#ifdef NAVJIT_VECGEOM
void add_vecgeom(const std::string& detector, const std::vector<peers::Flight>& flights,
                 bool safety, std::vector<Engine>& engines) {
  auto loaded = peers::VecGeomPeer::load(detector);
  if (!loaded) {
    std::printf("VecGeom does not read this file: %s\n", loaded.failure().message.c_str());
    return;
  }
  const std::shared_ptr<peers::VecGeomPeer> peer = *std::move(loaded);
  for (const auto& [name, navigator] : bench::vecgeom_navigators) {
    engines.push_back({name, [peer, n = navigator] { peer->use(n); },
                       [peer, &flights, safety] {
                         bench::Followed done;
                         const auto totals = peer->fly(flights, safety, done.safeties);
                         done.steps = totals.steps;
                         done.length = totals.length;
                         return done;
                       }});
  }
}
#endif

/// Returns the speed-up that specialisation brings; unmeasured if no flight makes a step.
double measure(const std::string& file, const Options& options) {
  const auto world = std::make_shared<const World>(read_world(file));
  const std::vector<Ray> primaries = bench::rays_of_any(options.rays, *world);
  Specialised generic(world, JitMode::off, false), made(world, JitMode::on, options.perf_map);
  const auto flights = options.only_photons
                           ? bench::photons(generic.runtime, primaries, options.photons)
                           : bench::shower(generic.runtime, primaries, options.shower);
  std::vector<Engine> engines;
  for (Specialised* s : {&generic, &made}) {
    engines.push_back({s == &made ? "navjit specialised" : "navjit generic", [] {},
                       [&flights, s, asked = options.asked] {
                         return bench::follow(s->navigator, flights, asked);
                       }});
  }
  bench::warm_up(made.runtime, 5, [&] { bench::follow(made.navigator, flights, options.asked); });
#ifdef NAVJIT_VECGEOM
  if (options.peers) add_vecgeom(file, flights, options.asked != bench::Asked::none, engines);
#endif
  for (int r = -1; r < options.repetitions; ++r) {  // the first one warms up and is not counted
    for (Engine& engine : engines) {
      engine.prepare();
      const double start = common::thread_ns();
      engine.done = engine.run();
      if (r >= 0) engine.ns.push_back(common::thread_ns() - start);
    }
  }
  for (const Engine& engine : engines) {
    const double ns = bench::each(common::summarise(engine.ns).median, engine.done.steps);
    const common::Summary gain = common::ratio(engines[0].ns, engine.ns);
    std::printf("| %s | %s | %llu | %.9g | %.7g | %s | %s |\n",
                std::filesystem::path(file).stem().c_str(), engine.name.c_str(),
                static_cast<unsigned long long>(engine.done.steps), engine.done.length,
                engine.done.safeties, bench::cell(ns, 1).c_str(),
                engine.done.steps > 0 ? bench::cell(gain, 2).c_str() : "-");
  }
  std::fflush(stdout);
  return engines[1].done.steps > 0 ? common::ratio(engines[0].ns, engines[1].ns).median
                                   : bench::unmeasured;
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app{"Particles that scatter and have secondaries: navjit and VecGeom side by side"};
  std::vector<std::string> detectors;
  Options options;
  options.rays.count = 1000;
  options.rays.aim = "auto";
  app.add_option("detectors", detectors, "GDML files")->required();
  bench::add_ray_options(app, options.rays);
  app.add_option("--mean-step", options.shower.mean_step,
                 "mm, in what is denser than a gas (default: a fifth of the radiation length)")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--steps", options.shower.most_steps, "that end within a volume, of a primary")
      ->check(bench::range_of_steps());
  auto* photons = app.add_flag("--photons", options.only_photons,
                               "optical photons instead of a shower: they fly on or are reflected");
  app.add_option("--reflected", options.photons.reflected, "of the photons at a boundary, 0 to 1")
      ->check(CLI::Range(0.0, 1.0))
      ->needs(photons);
  app.add_option("--repetitions", options.repetitions, "of each engine, in turn")
      ->check(bench::range_of_repetitions());
  const std::map<std::string, bench::Asked> safeties{{"whole", bench::Asked::whole},
                                                     {"enough", bench::Asked::enough},
                                                     {"none", bench::Asked::none}};
  app.add_option("--safety", options.asked,
                 "before each step: whole, enough for the step (VecGeom: whole), or none")
      ->transform(CLI::CheckedTransformer(safeties));
  app.add_flag("!--without-peers", options.peers, "navjit alone");
  bool verbose = false;
  app.add_flag("--verbose", verbose, "log what is specialised, and what is judged how");
  app.add_flag("--perf-map", options.perf_map, "name generated functions for perf");
  CLI11_PARSE(app, argc, argv);
  spdlog::set_default_logger(spdlog::stderr_color_mt("navjit"));
  spdlog::set_level(verbose ? spdlog::level::debug : spdlog::level::warn);
  if (options.only_photons) options.asked = bench::Asked::none;  // nothing scatters
  options.photons.most_steps = options.shower.most_steps;
  if (detectors.size() > 1) options.peers = false;  // VecGeom holds one detector in a process
  std::printf(
      "| detector | engine | steps | length, mm | safeties, mm | ns/step | speed-up over navjit "
      "generic (quartiles) |\n|---|---|--:|--:|--:|--:|--:|\n");
  std::vector<double> gains;
  for (const std::string& detector : detectors) gains.push_back(measure(detector, options));
  std::printf("\nSpecialised: %s times on average, %s at worst\n",
              bench::cell(bench::mean_of(gains), 2).c_str(),
              bench::cell(bench::worst_of(gains), 2).c_str());
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "simulation: %s\n", error.what());
  return 1;
}
