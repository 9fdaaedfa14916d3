// Compares transport through whole detectors: navjit's generic and specialised navigators and, if
// it was found, VecGeom's, on the same rays in the same process, taking turns at every repetition.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "bench/cells.hpp"
#include "bench/choices.hpp"
#include "bench/json_file.hpp"
#include "bench/ranges.hpp"
#include "bench/ray_options.hpp"
#include "common/clock.hpp"
#include "common/statistics.hpp"
#include "geometry/gdml/read_world.hpp"
#include "navjit/runtime.hpp"
#include "runtime/transport_basket.hpp"
#ifdef NAVJIT_VECGEOM_LOOP
#include "bench/vecgeom_loop.hpp"
#endif

namespace {

using namespace navjit;

struct Totals {
  std::uint64_t steps = 0;
  std::uint64_t stuck = 0;
  double length = 0;
};

struct Engine {
  std::string name;
  std::function<void()> prepare;  ///< before each repetition, not timed
  std::function<Totals()> run;
  Totals totals{};
  std::vector<double> cycles_per_ray{};
  std::vector<double> ns_per_ray{};
};

void add(Totals& totals, const RayTotals& ray) {
  totals.steps += ray.steps;
  totals.length += ray.length;
  totals.stuck += ray.stuck ? 1 : 0;
}

Totals transport_all(Navigator& navigator, const World& world, const std::vector<Ray>& rays) {
  Totals totals;
  for (const Ray& ray : rays) add(totals, transport(navigator, ray, world.tolerance));
  return totals;
}

Totals transport_all(Basket& basket, const World& world, const std::vector<Ray>& rays) {
  Totals totals;
  const auto each = transport_in_basket(
      basket, rays, world.tolerance, [](std::size_t, const State&, double) {}, [] { return true; });
  for (const RayTotals& ray : each) add(totals, ray);
  return totals;
}

/// As transport(), but by Navigator::steps(): up to so many boundaries in a call.
Totals transport_all(Navigator& navigator, const World& world, const std::vector<Ray>& rays,
                     std::size_t at_once) {
  std::vector<Step> buffer(at_once);
  Totals totals;
  for (const Ray& ray : rays) {
    Vec3 point = ray.position;
    double limit = std::numeric_limits<double>::infinity();
    detail::Standing standing;
    for (State state = navigator.locate(point, ray.direction); state.inside();) {
      for (const Step& step : navigator.steps(state, point, ray.direction, limit, buffer)) {
        standing.count(step.length, world.tolerance);
        if (standing.stuck()) break;
        ++totals.steps;
        totals.length += step.length;
        state = step.next;
      }
      if (standing.stuck()) {
        ++totals.stuck;
        break;
      }
    }
  }
  return totals;
}

#ifdef NAVJIT_VECGEOM
void add_vecgeom(const std::string& detector, const std::vector<Ray>& rays,
                 std::vector<Engine>& engines, std::shared_ptr<void>& keep) {
  auto loaded = peers::VecGeomPeer::load(detector);
  if (!loaded) {
    std::printf("VecGeom does not read this file: %s\n", loaded.failure().message.c_str());
    return;
  }
  const std::shared_ptr<peers::VecGeomPeer> peer = *std::move(loaded);
  auto own_rays = std::make_shared<std::vector<peers::Ray>>();
  for (const Ray& r : rays) {
    own_rays->push_back({{r.position.x, r.position.y, r.position.z},
                         {r.direction.x, r.direction.y, r.direction.z}});
  }
  for (const auto& [name, navigator] : bench::vecgeom_navigators) {
    engines.push_back({name, [peer, n = navigator] { peer->use(n); },
                       [peer, own_rays] {
                         const auto t = peer->transport(*own_rays, 1'000'000);
                         return Totals{t.steps - t.zero_steps, t.stuck, t.length};
                       }});
  }
  keep = peer;
#ifdef NAVJIT_VECGEOM_LOOP
  // VecGeom's loop once more, over its own volumes, but with navjit's answers.
  try {
    auto loop = std::make_shared<bench::VecGeomLoop>();
    engines.push_back({"VecGeom's loop over navjit", [loop] { loop->attach(); },
                       [peer, own_rays] {
                         const auto t = peer->transport(*own_rays, 1'000'000);
                         return Totals{t.steps - t.zero_steps, t.stuck, t.length};
                       }});
    // What the loop and the states add: for comparison, navjit's own loop over the same navigators.
    auto navigator = std::make_shared<Navigator>(loop->runtime().navigator());
    engines.push_back({"navjit's loop over VecGeom's volumes", [] {},
                       [loop, navigator, &rays] {
                         return transport_all(*navigator, loop->runtime().world(), rays);
                       }});
  } catch (const Error& refused) {
    std::printf("navjit does not take VecGeom's volumes: %s\n", refused.what());
  }
#endif
}
#endif

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app{"Transport through a whole detector: navjit and VecGeom side by side"};
  std::string detector, json_file;
  bench::RayOptions ray_options;
  int repetitions = 9;
  bool without_peers = false, without_jit = false, without_constants = false;
  std::vector<InstructionSet> sets{InstructionSet::native};
  std::vector<std::size_t> baskets, at_once;
  app.add_option("detector", detector, "GDML file")->required();
  bench::add_ray_options(app, ray_options);
  app.add_option("--repetitions", repetitions, "of each engine, in turn")
      ->check(bench::range_of_repetitions());
  app.add_option("--json", json_file, "write the figures");
  app.add_flag("--without-peers", without_peers, "navjit alone");
  app.add_flag("--without-jit", without_jit, "no specialised navigators");
  app.add_flag("--without-constants", without_constants, "scenes are bound to data alone");
  app.add_option("--basket", baskets,
                 "also so many rays at once, from a basket; several with commas")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  app.add_option("--steps", at_once,
                 "also up to so many boundaries in a call (Navigator::steps); several with commas")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  bench::add_isa_option(app, sets);
  CLI11_PARSE(app, argc, argv);

  bench::JsonFile figures(json_file);
  const auto world = std::make_shared<const World>(read_world(detector));
  const std::vector<Ray> rays = bench::rays_of(ray_options, *world);

  RuntimeOptions off;
  off.jit = JitMode::off;
  Runtime generic(world, off);
  Navigator generic_navigator = generic.navigator();
  std::vector<Engine> engines;
  engines.push_back(
      {"navjit generic", [] {}, [&] { return transport_all(generic_navigator, *world, rays); }});
  const auto add_several = [&](const std::string& name, Navigator& navigator) {
    for (const std::size_t room : at_once) {
      engines.push_back({name + ", " + std::to_string(room) + " boundaries a call", [] {},
                         [&, room] { return transport_all(navigator, *world, rays, room); }});
    }
  };
  add_several("navjit generic", generic_navigator);
  struct Specialised {
    Runtime runtime;
    Navigator navigator;
    Specialised(const std::shared_ptr<const World>& of, const RuntimeOptions& options)
        : runtime(of, options), navigator(runtime.navigator()) {}
  };
  std::vector<std::unique_ptr<Specialised>> specialised;
  for (const InstructionSet set : without_jit ? std::vector<InstructionSet>{} : sets) {
    RuntimeOptions wait;
    wait.jit = JitMode::wait;
    wait.specialiser.instruction_set = set;
    wait.specialiser.constants = wait.specialiser.structures = !without_constants;
    wait.specialiser.solids = !without_constants;
    Specialised& made = *specialised.emplace_back(std::make_unique<Specialised>(world, wait));
    const std::string name = bench::specialised_name(set, sets);
    engines.push_back({name, [] {}, [&] { return transport_all(made.navigator, *world, rays); }});
    add_several(name, made.navigator);
    for (const std::size_t places : baskets) {
      const auto basket = std::make_shared<Basket>(made.runtime.basket(places));
      engines.push_back({name + ", basket of " + std::to_string(places), [] {},
                         [&, basket] { return transport_all(*basket, *world, rays); }});
    }
  }
  std::shared_ptr<void> keep;
#ifdef NAVJIT_VECGEOM
  if (!without_peers) add_vecgeom(detector, rays, engines, keep);
#endif
  for (int r = -1; r < repetitions; ++r) {  // the first one warms up and is not counted
    for (Engine& engine : engines) {
      engine.prepare();
      const double before = common::cycles_per_ns();
      const double start = common::thread_ns();
      engine.totals = engine.run();
      const double ns = common::thread_ns() - start;
      if (r < 0) continue;
      const double clock = (before + common::cycles_per_ns()) / 2;
      engine.ns_per_ray.push_back(ns / static_cast<double>(rays.size()));
      engine.cycles_per_ray.push_back(ns * clock / static_cast<double>(rays.size()));
    }
  }

  // An engine that makes more steps for the same rays must not look better for it: the ratio is
  // that of times per ray, and ns/step counts steps that move the ray.
  std::printf("%s: %zu rays, %d repetitions\n\n", detector.c_str(), rays.size(), repetitions);
  std::printf(
      "| engine | steps | length, mm | stuck | ns/step (quartiles) | cycles/step, lowest quartile "
      "| ns/ray | "
      "speed-up over navjit generic (quartiles) |\n|---|--:|--:|--:|--:|--:|--:|--:|\n");
  nlohmann::ordered_json json{{"detector", detector}, {"rays", rays.size()}};
  for (const Engine& engine : engines) {
    const common::Summary ns = common::summarise(engine.ns_per_ray);
    // Unmeasured without a step: rays that only miss the world are no transport.
    const double per_step = bench::each(static_cast<double>(rays.size()), engine.totals.steps);
    const common::Summary ns_per_step{ns.median * per_step, ns.low * per_step, ns.high * per_step};
    common::Summary gain = common::ratio(engines[0].ns_per_ray, engine.ns_per_ray);
    if (engine.totals.steps == 0) gain.median = bench::unmeasured;
    std::printf("| %s | %llu | %.9g | %llu | %s | %s | %s | %s |\n", engine.name.c_str(),
                static_cast<unsigned long long>(engine.totals.steps), engine.totals.length,
                static_cast<unsigned long long>(engine.totals.stuck),
                bench::cell(ns_per_step, 1).c_str(),
                bench::cell(common::quantile(engine.cycles_per_ray, 0.25) * per_step, 0).c_str(),
                bench::cell(rays.empty() ? bench::unmeasured : ns.median, 0).c_str(),
                bench::cell(gain, 2).c_str());
    json["engines"].push_back({{"name", engine.name},
                               {"steps", engine.totals.steps},
                               {"stuck", engine.totals.stuck},
                               {"length_mm", engine.totals.length},
                               {"ns_per_ray", engine.ns_per_ray},
                               {"cycles_per_ray", engine.cycles_per_ray},
                               {"ns_per_step", ns_per_step.median},
                               {"speed_up_over_generic", gain.median}});
  }
  figures.write(json);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "transport: %s\n", error.what());
  return 1;
}
