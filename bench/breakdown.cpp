// Where the time of specialised transport goes, by scene and by what is done there, from samples or
// instruction by instruction; and the time that it needs at the least.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "bench/cells.hpp"
#include "bench/choices.hpp"
#include "bench/code_map.hpp"
#include "bench/floor.hpp"
#include "bench/json_file.hpp"
#include "bench/ladder_table.hpp"
#include "bench/ranges.hpp"
#include "bench/ray_options.hpp"
#include "bench/sampler.hpp"
#include "common/clock.hpp"
#include "common/statistics.hpp"
#include "geometry/gdml/read_world.hpp"
#include "navjit/detail/standing.hpp"
#include "navjit/runtime.hpp"

namespace {

using namespace navjit;
using bench::unmeasured;

enum Phase : std::size_t {
  step_frame,
  step_exit,
  step_candidates,
  step_daughters,
  step_rest,
  relocation_frame,
  relocation_candidates,
  relocation_solids,
  relocation_push,
  relocation_rest,
  dispatch,
  starts_of_rays,
  generic_navigator,
  elsewhere,
  phases
};
constexpr std::array<const char*, phases> phase_names{
    "step: point and direction into the frame",
    "step: way out of the volume",
    "step: candidates among daughters",
    "step: distances to daughters",
    "step: the rest (state, calls, choice)",
    "relocation: point and direction into frames",
    "relocation: candidates",
    "relocation: whether solids contain the point",
    "relocation: frames pushed",
    "relocation: the rest (state, calls, choice)",
    "dispatch, profile, the caller's loop",
    "starts of rays",
    "generic navigator",
    "elsewhere (libraries, system)"};

bool begins(const std::string& text, const char* with) { return text.rfind(with, 0) == 0; }

template <std::size_t N>
bool one_of(const std::string& name, const std::array<const char*, N>& names) {
  return std::any_of(names.begin(), names.end(), [&](const char* n) { return name == n; });
}

/// The phase of a function, by the names that generated code gives its functions (codegen/).
Phase phase_of(const bench::CodeMap::Place& place) {
  if (place.functions.empty()) return elsewhere;
  if (!place.generated) {
    const std::string& name = place.functions[0];
    if (name.find("transport_all") != std::string::npos) return dispatch;
    return name.find("navjit") != std::string::npos ? generic_navigator : elsewhere;
  }
  const std::string& outermost = place.functions[0];
  const bool step = begins(outermost, "navjit_step_");
  bool candidates = false;
  for (const std::string& f : place.functions) {
    if (one_of<5>(f, {"point", "direction", "heading", "ray", "turned_ray"})) {
      return step && f != "heading" ? step_frame : relocation_frame;
    }
    if (begins(f, "push")) return relocation_push;
    if (f == "holds" || begins(f, "contains")) return relocation_solids;
    if (f == "distance" || begins(f, "distance_to_in") || begins(f, "distance_to_entry")) {
      return step_daughters;
    }
    if (begins(f, "distance_to_out") || begins(f, "distance_to_exit")) return step_exit;
    candidates |= begins(f, "nearest") || begins(f, "find") || f == "is_there";
  }
  // Functions that are not inlined and belong to no scene: the kernels themselves.
  if (begins(outermost, "exit_") || begins(outermost, "distance_")) return step_exit;
  if (step || begins(outermost, "nearest_from")) return candidates ? step_candidates : step_rest;
  return candidates ? relocation_candidates : relocation_rest;
}

/// In place of the scene while it is looked for where a ray starts, which is no step of any scene.
constexpr VolumeId no_scene = std::numeric_limits<VolumeId>::max();

/// Instructions are counted for so many steps: at a thousand for each, a Sampler can hold them.
constexpr std::uint64_t steps_counted = 7000;

std::uint64_t transport_all(Navigator& navigator, const std::vector<Ray>& rays, double tolerance) {
  std::uint64_t steps = 0;
  for (const Ray& ray : rays) {
    Vec3 point = ray.position;
    detail::Standing standing;
    bench::sampled_scene = no_scene;
    for (State state = navigator.locate(point, ray.direction); state.inside() && !standing.stuck();
         ++steps) {
      bench::sampled_scene = state.volume();
      const Step step = navigator.step(state, point, ray.direction);
      standing.count(step.length, tolerance);
      point += step.length * ray.direction;
      state = step.next;
    }
  }
  return steps;
}

/// Samples by phase, and by scene and phase. Those at the starts of rays are of no scene.
struct Counts {
  std::map<VolumeId, std::array<double, phases>> of;
  std::array<double, phases> all{};
  double total = 0;

  void add(bench::CodeMap& map, const std::vector<bench::CodeSample>& samples) {
    for (const bench::CodeSample& s : samples) {
      const Phase phase = s.scene == no_scene ? starts_of_rays : phase_of(map.at(s.address));
      if (s.scene != no_scene) of[s.scene][phase] += 1;
      all[phase] += 1;
      total += 1;
    }
  }
};

double sum(const std::array<double, phases>& values, std::size_t first, std::size_t last) {
  double total = 0;
  for (std::size_t i = first; i <= last; ++i) total += values[i];
  return total;
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app{"Where the time of specialised transport goes, and its floor"};
  std::string detector, json_file;
  bench::RayOptions ray_options;
  double seconds = 10;
  std::size_t top = 12;
  bool instructions = false, ladder = false;
  std::vector<InstructionSet> sets{InstructionSet::native};
  app.add_option("detector", detector, "GDML file")->required();
  bench::add_ray_options(app, ray_options);
  app.add_option("--seconds", seconds, "of sampling")->check(bench::range_of_seconds());
  app.add_option("--scenes", top, "rows of the table by scene");
  app.add_flag("--instructions", instructions,
               "count the instructions of some thousand steps, too");
  app.add_flag("--ladder", ladder, "the floor again, with one promise of a step more at a time");
  app.add_option("--json", json_file, "write the figures");
  bench::add_isa_option(app, sets);
  CLI11_PARSE(app, argc, argv);

  bench::JsonFile figures(json_file);
  const auto world = std::make_shared<const World>(read_world(detector));
  const std::vector<Ray> rays = bench::rays_of(ray_options, *world);

  RuntimeOptions options;
  options.jit = JitMode::wait;
  options.specialiser.instruction_set = sets.at(0);
  options.specialiser.debug_info = true;
  options.specialiser.safety = false;
  Runtime runtime(world, options);
  Navigator navigator = runtime.navigator();
  const Geometry geometry(world);
  const bench::Floor floor(geometry, rays);
  const double tolerance = world->tolerance;

  // Both are timed in turn.
  std::vector<double> ns, floor_ns, cycles, floor_cycles;
  std::uint64_t steps = transport_all(navigator, rays, tolerance);
  if (steps == 0) throw Error(detector + ": no ray makes a step; give rays that meet the world");
  double length = floor.run();
  for (int r = 0; r < 15; ++r) {
    const double before = common::cycles_per_ns();
    const double start = common::thread_ns();
    steps = transport_all(navigator, rays, tolerance);
    const double middle = common::thread_ns();
    length = floor.run();
    const double end = common::thread_ns();
    const double clock = (before + common::cycles_per_ns()) / 2;
    ns.push_back((middle - start) / double(steps));
    floor_ns.push_back((end - middle) / double(floor.steps()));
    cycles.push_back(ns.back() * clock);
    floor_cycles.push_back(floor_ns.back() * clock);
  }
  const common::Summary per_step = common::summarise(ns);
  const double step_cycles = common::quantile(cycles, 0.25);

  bench::CodeMap map;
  bench::Sampler sampler;
  Counts time;
  sampler.start();  // once, since short passes would be sampled at their ends only
  for (const double start = common::thread_ns(); common::thread_ns() - start < 1e9 * seconds;) {
    transport_all(navigator, rays, tolerance);
  }
  sampler.stop();
  time.add(map, sampler.take());
  Counts instruction;
  std::uint64_t counted_steps = 0;
  std::map<VolumeId, std::uint64_t> counted_in;
  if (instructions) {
    std::vector<Ray> few;
    for (const Ray& ray : rays) {
      if (counted_steps > steps_counted) break;
      few.push_back(ray);
      counted_steps += transport(navigator, ray, tolerance, [&](const State& state, double) {
                         ++counted_in[state.volume()];
                       }).steps;
    }
    sampler.start_stepping();
    transport_all(navigator, few, tolerance);
    sampler.stop_stepping();
    instruction.add(map, sampler.take());
  }

  const bool counted = instruction.total > 0;  // not on every machine

  std::map<VolumeId, std::uint64_t> steps_in;
  for (const Ray& ray : rays) {
    transport(navigator, ray, tolerance,
              [&](const State& state, double) { ++steps_in[state.volume()]; });
  }

  std::printf("%s: %zu rays, %llu steps, %.9g mm by the floor's replay\n\n", detector.c_str(),
              rays.size(), static_cast<unsigned long long>(steps), length);
  std::printf("| | ns/step (quartiles) | cycles/step, lowest quartile |\n|---|--:|--:|\n");
  std::printf("| specialised | %.1f (%.1f..%.1f) | %.0f |\n", per_step.median, per_step.low,
              per_step.high, step_cycles);
  const common::Summary least = common::summarise(floor_ns);
  std::printf(
      "| floor: each step's one transformation, one distance, next point | %.1f (%.1f..%.1f) | "
      "%.0f |\n\n",
      least.median, least.low, least.high, common::quantile(floor_cycles, 0.25));
  std::printf("| part | share of samples | cycles/step |%s\n|---|--:|--:|%s\n",
              instructions ? " instructions/step |" : "", instructions ? "--:|" : "");
  nlohmann::ordered_json json{{"detector", detector},
                              {"rays", rays.size()},
                              {"steps", steps},
                              {"ns_per_step", ns},
                              {"cycles_per_step", cycles},
                              {"floor_ns_per_step", floor_ns},
                              {"floor_cycles_per_step", floor_cycles},
                              {"samples", time.total}};
  for (std::size_t p = 0; p < phases; ++p) {
    const double share = time.all[p] / std::max(time.total, 1.0);
    const double count_here = counted ? bench::each(instruction.all[p], counted_steps) : unmeasured;
    if (time.all[p] == 0 && instruction.all[p] == 0) continue;
    std::printf("| %s | %.1f%% | %.0f |", phase_names[p], 100 * share, share * step_cycles);
    if (instructions) std::printf(" %s |", bench::cell(count_here, 1).c_str());
    std::printf("\n");
    json["parts"].push_back({{"part", phase_names[p]},
                             {"share", share},
                             {"cycles_per_step", share * step_cycles},
                             {"instructions_per_step", count_here}});
  }
  if (instructions) {
    const double all = counted ? bench::each(instruction.total, counted_steps) : unmeasured;
    std::printf("| all | 100%% | %.0f | %s |\n", step_cycles, bench::cell(all, 1).c_str());
  }

  std::vector<std::pair<double, VolumeId>> hottest;
  hottest.reserve(time.of.size());
  for (const auto& [volume, counts] : time.of) {
    hottest.push_back({sum(counts, 0, phases - 1), volume});
  }
  std::sort(hottest.rbegin(), hottest.rend());
  std::printf(
      "\n| steps made in | share of steps | share of time | cycles/step | instructions/step | "
      "frame | exit | "
      "candidates "
      "| daughters | rest | relocation: frames | candidates | solids | push | rest | dispatch | "
      "generic, elsewhere |\n"
      "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  for (std::size_t i = 0; i < std::min(top, hottest.size()); ++i) {
    const auto [samples, volume] = hottest[i];
    const auto& counts = time.of[volume];
    const double share = samples / time.total;
    const double here = double(steps_in[volume]) / double(steps);
    const double scale = step_cycles / std::max(here, 1e-12) / time.total;
    const double instructions_here =
        counted ? bench::each(sum(instruction.of[volume], 0, phases - 1), counted_in[volume])
                : unmeasured;
    std::printf("| %s | %.1f%% | %.1f%% | %.0f | %s |", world->volumes[volume].name.c_str(),
                100 * here, 100 * share, samples * scale,
                bench::cell(instructions_here, 0).c_str());
    for (std::size_t p = 0; p <= dispatch; ++p) std::printf(" %.0f |", counts[p] * scale);
    std::printf(" %.0f |\n", sum(counts, generic_navigator, elsewhere) * scale);
    json["scenes"].push_back({{"volume", world->volumes[volume].name},
                              {"steps_share", here},
                              {"time_share", share},
                              {"cycles_per_step", samples * scale},
                              {"instructions_per_step", instructions_here}});
  }
  if (ladder) bench::print_ladder(geometry, runtime, rays, instructions, json);
  figures.write(json);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "breakdown: %s\n", error.what());
  return 1;
}
