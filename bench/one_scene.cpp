// Measures one scene by the method of Wenzel et al., section 2.5: rays start at random points of
// one volume; each makes one step to the next boundary and is relocated after it. With --safety it
// asks instead for the safety at the start of each ray.
//
// Every engine gets its own located states, as a simulation would hold them after the step before:
// VecGeom its navigation states, navjit navigators that stand in the touchable. What brings the
// states there is not timed. So navjit is timed chunk by chunk: by ticks, since to read the
// thread's time takes as long as several rays. Ticks go on while others have the processor, so
// chunks in which that happened are left out (bench/interrupted.hpp). VecGeom's states all exist
// beforehand: it is timed over a whole block, by the thread's time.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>

#include "bench/choices.hpp"
#include "bench/interrupted.hpp"
#include "bench/json_file.hpp"
#include "bench/ranges.hpp"
#include "bench/scene_states.hpp"
#include "common/clock.hpp"
#include "common/statistics.hpp"
#include "geometry/gdml/read_world.hpp"
#include "navjit/errors.hpp"
#include "runtime/overrides.hpp"

namespace {

using namespace navjit;

/// The number of rays in a chunk: the stacks of their navigators stay in the first-level cache, as
/// the stack of a track does.
constexpr std::size_t chunk = 16;

struct Sums {
  double ns = 0;
  double length = 0;
};

struct Engine {
  std::string name;
  std::function<Sums(std::size_t block)> run;
  std::vector<double> ns_per_ray{};  ///< by repetition and block
  double length = 0;
};

/// A navigator for every ray of a chunk.
class SceneRunner {
 public:
  SceneRunner(const std::shared_ptr<const World>& world, const RuntimeOptions& options, bool safety)
      : runtime_(world, options), safety_(safety) {
    for (std::size_t i = 0; i < chunk; ++i) navigators_.push_back(runtime_.navigator());
  }

  Sums run(std::span<const bench::SceneRay> rays) {
    Sums sums;
    for (std::size_t first = 0; first < rays.size(); first += chunk) {
      const auto part = rays.subspan(first, std::min(chunk, rays.size() - first));
      for (std::size_t i = 0; i < part.size(); ++i) {
        // A step of no length brings the navigator there. Its direction is another one, so that
        // nothing which is kept for it helps the step that is timed.
        navigators_[i].step(part[i].state, part[i].ray.position, {0.6, 0, 0.8}, 0.0);
      }
      const std::uint64_t start = common::ticks();
      for (std::size_t i = 0; i < part.size(); ++i) sums.length += ask(navigators_[i], part[i]);
      ticks_.push_back(static_cast<double>(common::ticks() - start) /
                       static_cast<double>(part.size()));
    }
    sums.ns = bench::mean_uninterrupted(ticks_) * common::ns_per_tick() *
              static_cast<double>(rays.size());
    ticks_.clear();
    return sums;
  }

  /// Steps only from states to which the navigator has to be brought, one after the other: this
  /// includes the cost of a jump to another track.
  Sums run_from_states(std::span<const bench::SceneRay> rays) {
    Sums sums;
    const double start = common::thread_ns();
    for (const bench::SceneRay& r : rays) sums.length += ask(navigators_[0], r);
    sums.ns = common::thread_ns() - start;
    return sums;
  }

  /// Whether the volume has a navigator of its own, of whatever binding.
  bool specialised(const std::string& volume) const {
    for (const SceneReport& scene : runtime_.report().scenes) {
      if (scene.volume == volume) return scene.binding != Binding::generic;
    }
    return false;
  }

 private:
  double ask(Navigator& navigator, const bench::SceneRay& r) const {
    return safety_ ? navigator.safety(r.state, r.ray.position)
                   : navigator.step(r.state, r.ray.position, r.ray.direction).length;
  }

  Runtime runtime_;
  bool safety_;
  std::vector<Navigator> navigators_;
  std::vector<double> ticks_;  ///< by chunk: ticks for each ray
};

#ifdef NAVJIT_VECGEOM
std::vector<peers::Ray> peer_rays(std::span<const bench::SceneRay> rays) {
  std::vector<peers::Ray> result;
  for (const bench::SceneRay& r : rays) {
    const Vec3 p = r.ray.position, d = r.ray.direction;
    result.push_back({{p.x, p.y, p.z}, {d.x, d.y, d.z}});
  }
  return result;
}

/// VecGeom's states and rays, by block.
struct PeerBlocks {
  std::vector<std::vector<peers::Ray>> rays;
  std::vector<peers::VecGeomPeer::States> states;
};
#endif

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app{"One step and relocation from random points of one volume: navjit and VecGeom"};
  std::string detector, json_file;
  std::vector<std::string> volumes;
  std::size_t count = 500'000;
  std::uint64_t seed = 1;
  int repetitions = 3;
  std::size_t blocks = 10;
  bool without_peers = false, perf_map = false, safety = false;
  std::vector<InstructionSet> sets{InstructionSet::native};
  std::vector<std::string> variants;
  app.add_option("detector", detector, "GDML file")->required();
  app.add_option("--volume", volumes, "logical volumes, each a table")->required()->delimiter(',');
  app.add_option("--count", count, "rays")->check(bench::range_of_counts());
  app.add_option("--seed", seed, "of the rays");
  app.add_option("--repetitions", repetitions, "of all rays")->check(bench::range_of_repetitions());
  app.add_option("--blocks", blocks, "of rays, timed engine by engine in turn")
      ->check(CLI::PositiveNumber);
  app.add_option("--json", json_file, "write the figures");
  app.add_flag("--without-peers", without_peers, "navjit alone");
  app.add_flag("--safety", safety, "safety at the starts instead of steps");
  app.add_flag("--perf-map", perf_map, "name generated functions for perf");
  app.add_option("--variants", variants,
                 "candidates that the volumes are forced to, in turn with it")
      ->delimiter(',');
  bench::add_isa_option(app, sets);
  CLI11_PARSE(app, argc, argv);

  bench::JsonFile figures(json_file);
  const auto world = std::make_shared<const World>(read_world(detector));
  RuntimeOptions off;
  off.jit = JitMode::off;
  Runtime generic(world, off);
  std::vector<std::unique_ptr<SceneRunner>> runners;
  runners.push_back(std::make_unique<SceneRunner>(world, off, safety));
  for (const InstructionSet set : sets) {
    RuntimeOptions wait;
    wait.jit = JitMode::wait;
    wait.specialiser.instruction_set = set;
    wait.specialiser.perf_map = perf_map;
    runners.push_back(std::make_unique<SceneRunner>(world, wait, safety));
  }
  for (const std::string& variant : variants) {
    std::string overrides = "*=off";
    const std::string forced = "=" + variant;
    for (const std::string& name : volumes) overrides.append(",").append(name).append(forced);
    RuntimeOptions wait;
    wait.jit = JitMode::wait;
    setenv(overrides_variable, overrides.c_str(), 1);
    runners.push_back(std::make_unique<SceneRunner>(world, wait, safety));
    unsetenv(overrides_variable);
  }
#ifdef NAVJIT_VECGEOM
  std::unique_ptr<peers::VecGeomPeer> peer;
  if (!without_peers) {
    auto loaded = peers::VecGeomPeer::load(detector);
    if (loaded) {
      peer = *std::move(loaded);
    } else {
      std::printf("VecGeom does not read this file: %s\n", loaded.failure().message.c_str());
    }
  }
#endif
  nlohmann::ordered_json json{{"detector", detector}};
  for (const std::string& name : volumes) {
    VolumeId volume = 0;
    while (volume < world->volumes.size() && world->volumes[volume].name != name) ++volume;
    if (volume == world->volumes.size()) {
      const std::string what = ": no volume " + name;
      throw Error(detector + what);
    }
    std::vector<bench::SceneRay> rays = bench::rays_in_volume(generic, volume, count, seed);
#ifdef NAVJIT_VECGEOM
    if (peer) {
      // Uses only points that both engines find in the volume.
      const auto states = peer->prepare_states(peer_rays(rays));
      std::vector<bench::SceneRay> both;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const std::int64_t at = states.volume(i);
        if (at >= 0 && peer->names()[static_cast<std::size_t>(at)] == name) both.push_back(rays[i]);
      }
      if (both.size() != rays.size()) {
        std::printf("%s: %zu of %zu points left out, which VecGeom takes to be elsewhere\n",
                    name.c_str(), rays.size() - both.size(), rays.size());
      }
      rays = std::move(both);
    }
#endif
    if (rays.size() < blocks) {
      std::printf("%s: too few points found in the volume\n", name.c_str());
      continue;
    }
    const std::size_t per_block = rays.size() / blocks;
    const auto block = [&](std::size_t b) {
      return std::span<const bench::SceneRay>(rays).subspan(b * per_block, per_block);
    };
    std::vector<Engine> engines;
    engines.push_back({"navjit generic", [&](std::size_t b) { return runners[0]->run(block(b)); }});
    for (std::size_t s = 0; s < sets.size(); ++s) {
      engines.push_back({bench::specialised_name(sets[s], sets),
                         [&, s](std::size_t b) { return runners[s + 1]->run(block(b)); }});
    }
    for (std::size_t i = 0; i < variants.size(); ++i) {
      engines.push_back({"navjit " + variants[i], [&, i](std::size_t b) {
                           return runners[1 + sets.size() + i]->run(block(b));
                         }});
    }
    engines.push_back({"navjit generic, from states",
                       [&](std::size_t b) { return runners[0]->run_from_states(block(b)); }});
    engines.push_back({"navjit specialised, from states",
                       [&](std::size_t b) { return runners[1]->run_from_states(block(b)); }});
#ifdef NAVJIT_VECGEOM
    PeerBlocks of_peer;
    if (peer) {
      for (std::size_t b = 0; b < blocks; ++b) {
        of_peer.rays.push_back(peer_rays(block(b)));
        of_peer.states.push_back(peer->prepare_states(of_peer.rays.back()));
      }
      for (const auto& [label, navigator] : bench::vecgeom_navigators) {
        engines.push_back({label, [&, n = navigator](std::size_t b) {
                             peer->use(n);
                             const double start = common::thread_ns();
                             const double sum =
                                 safety ? peer->safety(of_peer.states[b], of_peer.rays[b])
                                        : peer->one_step(of_peer.states[b], of_peer.rays[b]).length;
                             return Sums{common::thread_ns() - start, sum};
                           }});
      }
    }
#endif
    for (int r = -1; r < repetitions; ++r) {  // the first one warms up and is not counted
      for (Engine& engine : engines) engine.length = 0;
      for (std::size_t b = 0; b < (r < 0 ? 1 : blocks); ++b) {
        for (Engine& engine : engines) {
          const Sums sums = engine.run(b);
          engine.length += sums.length;
          if (r >= 0) engine.ns_per_ray.push_back(sums.ns / static_cast<double>(per_block));
        }
      }
    }
    std::printf("%s, %s (%zu daughters%s): %zu rays, %d repetitions of %zu blocks\n\n",
                detector.c_str(), name.c_str(), world->volumes[volume].daughters.size(),
                runners[1]->specialised(name) ? "" : ", left generic", per_block * blocks,
                repetitions, blocks);
    std::printf(
        "| engine | ns/ray (quartiles) | mean answer, mm | speed-up over navjit generic "
        "(quartiles) | of navjit specialised over this (quartiles) |\n|---|--:|--:|--:|--:|\n");
    nlohmann::ordered_json table{{"volume", name}, {"rays", per_block * blocks}};
    for (const Engine& engine : engines) {
      const common::Summary ns = common::summarise(engine.ns_per_ray);
      const common::Summary gain = common::ratio(engines[0].ns_per_ray, engine.ns_per_ray);
      const common::Summary lead = common::ratio(engine.ns_per_ray, engines[1].ns_per_ray);
      std::printf("| %s | %.1f (%.1f..%.1f) | %.9g | %.2f (%.2f..%.2f) | %.2f (%.2f..%.2f) |\n",
                  engine.name.c_str(), ns.median, ns.low, ns.high,
                  engine.length / static_cast<double>(per_block * blocks), gain.median, gain.low,
                  gain.high, lead.median, lead.low, lead.high);
      table["engines"].push_back({{"name", engine.name},
                                  {"ns_per_ray", engine.ns_per_ray},
                                  {"median_ns", ns.median},
                                  {"mean_answer_mm", engine.length / double(per_block * blocks)},
                                  {"specialised_over_this", lead.median}});
    }
    std::printf("\n");
    json["volumes"].push_back(table);
  }
  figures.write(json);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "bench_scene: %s\n", error.what());
  return 1;
}
