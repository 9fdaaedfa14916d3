// Compares specialised navigators with the generic one, steps and safeties, bit by bit, on many
// rays through many detectors.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <bit>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "geometry/gdml/read_world.hpp"
#include "navjit/runtime.hpp"
#include "navjit/vector.hpp"
#include "tests/campaign/files.hpp"
#include "tests/campaign/starts.hpp"

namespace {

using namespace navjit;

struct Counts {
  std::uint64_t rays = 0, steps = 0, stuck = 0, differing = 0, bail_outs = 0;
  std::uint64_t specialised = 0;  ///< steps in scenes that have a specialised navigator
  std::uint64_t bound = 0;        ///< of these, in scenes that are bound as far as was asked

  Counts& operator+=(const Counts& o) {
    rays += o.rays;
    steps += o.steps;
    stuck += o.stuck;
    differing += o.differing;
    bail_outs += o.bail_outs;
    specialised += o.specialised;
    bound += o.bound;
    return *this;
  }
};

/// A step whose bits differ, or those of the safety before it, with what is needed to repeat it.
/// If a ray's start was located differently, it is what comes next in two steps of no length, and
/// `state` is outside.
struct Difference {
  std::uint64_t ray;
  State state;
  Vec3 point, direction;
  Step generic, specialised;
};

/// == compares touchables alone; code that volumes share looks up the volume, so compare that, too.
bool same(const State& a, const State& b) {
  return a == b && (!a.inside() || a.volume() == b.volume());
}

bool same(const Step& a, const Step& b) {
  return std::bit_cast<std::uint64_t>(a.length) == std::bit_cast<std::uint64_t>(b.length) &&
         a.boundary == b.boundary && same(a.next, b.next);
}

/// Follows one ray with both navigators, each step from the state that the generic one is in.
void run_ray(Navigator& generic, Navigator& specialised, const Ray& ray, std::uint64_t index,
             double tolerance, Counts& counts, std::vector<Difference>& differences) {
  ++counts.rays;
  Vec3 point = ray.position;
  detail::Standing standing;
  const auto differ = [&](const State& from, const Step& right, const Step& made) {
    ++counts.differing;
    if (differences.size() >= 10) return;
    differences.push_back({index, from, point, ray.direction, right, made});
  };
  State state = generic.locate(point, ray.direction);
  const State located = specialised.locate(point, ray.direction);
  if (!same(located, state)) differ({}, {0, false, state}, {0, false, located});
  while (state.inside()) {
    const Step right = generic.step(state, point, ray.direction);
    const double safety = generic.safety(state, point);
    const bool safe = std::bit_cast<std::uint64_t>(specialised.safety(state, point)) ==
                      std::bit_cast<std::uint64_t>(safety);
    const Step made = specialised.step(state, point, ray.direction);
    ++counts.steps;
    if (!safe || !same(right, made)) differ(state, right, made);
    standing.count(right.length, tolerance);
    if (standing.stuck()) {
      ++counts.stuck;
      return;
    }
    point += right.length * ray.direction;
    state = right.next;
  }
}

struct Options {
  std::uint64_t steps = 1000000;
  std::uint64_t seed = 1;
  unsigned threads = 1;
  JitMode jit = JitMode::wait;
  Binding binding = Binding::constants;  ///< the furthest that scenes are bound
  bool solids = false;                   ///< with code for their solids, even if to data
};

Counts run_file(const std::string& file, const Options& options,
                std::vector<Difference>& differences, std::shared_ptr<const World>& world) {
  world = std::make_shared<const World>(read_world(file));
  RuntimeOptions with;
  with.jit = options.jit;
  with.specialiser.keep_only_faster = false;  // what is slower has to be right, too
  with.specialiser.structures = options.binding != Binding::data;
  with.specialiser.constants = options.binding == Binding::constants;
  with.specialiser.solids = options.solids || options.binding != Binding::data;
  Runtime off(world, {.jit = JitMode::off}), specialising(world, with);
  std::atomic<std::uint64_t> next{0}, steps{0};
  Counts totals;
  std::mutex merging;
  const auto work = [&] {
    Navigator generic = off.navigator(), specialised = specialising.navigator();
    Counts counts;
    std::vector<Difference> found;
    // Rays that start outside make no steps: their number is bounded, too.
    for (std::uint64_t i;
         steps.load() < options.steps && (i = next.fetch_add(1)) < options.steps;) {
      const std::uint64_t before = counts.steps;
      run_ray(generic, specialised, campaign::make_grazing_ray(*world, options.seed, i), i,
              world->tolerance, counts, found);
      steps += counts.steps - before;
    }
    counts.bail_outs = specialised.counts().bail_outs;
    const std::lock_guard lock(merging);
    totals += counts;
    differences.insert(differences.end(), found.begin(), found.end());
  };
  {
    std::vector<std::jthread> workers;
    for (unsigned t = 1; t < options.threads; ++t) workers.emplace_back(work);
    work();
  }
  for (const SceneReport& scene : specialising.report().scenes) {
    if (scene.binding != Binding::generic) totals.specialised += scene.steps;
    if (scene.binding == options.binding) totals.bound += scene.steps;
  }
  return totals;
}

void print_row(const std::string& name, const Counts& c, double seconds) {
  const auto number = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
  const auto share = [&](std::uint64_t n) {
    return c.steps == 0 ? 0.0 : 100 * static_cast<double>(n) / static_cast<double>(c.steps);
  };
  std::printf("| %s | %llu | %llu | %.1f%% | %.1f%% | %llu | %llu | %llu | %.0f |\n", name.c_str(),
              number(c.rays), number(c.steps), share(c.specialised), share(c.bound),
              number(c.bail_outs), number(c.stuck), number(c.differing), seconds);
  std::fflush(stdout);
}

void print_difference(const World& world, const Difference& d) {
  const Vec3 &p = d.point, &v = d.direction;
  const auto next = [&](const Step& s) {
    return s.next.inside() ? path_of(world, s.next.touchable()) : std::string("outside");
  };
  if (!d.state.inside()) {
    std::fprintf(stderr,
                 "  ray %llu at (%a, %a, %a) along (%a, %a, %a): located %s instead of %s\n",
                 static_cast<unsigned long long>(d.ray), p.x, p.y, p.z, v.x, v.y, v.z,
                 next(d.specialised).c_str(), next(d.generic).c_str());
    return;
  }
  std::fprintf(stderr,
               "  ray %llu in %s from (%a, %a, %a) along (%a, %a, %a): %a to %s instead of %a to "
               "%s\n",
               static_cast<unsigned long long>(d.ray), path_of(world, d.state.touchable()).c_str(),
               p.x, p.y, p.z, v.x, v.y, v.z, d.specialised.length, next(d.specialised).c_str(),
               d.generic.length, next(d.generic).c_str());
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Specialised navigators of level `exact` against generic ones, bit by bit.");
  std::vector<std::string> files;
  std::string json_file;
  Options options;
  double steps = 1e6;
  bool in_background = false;
  app.add_option("files", files, "GDML files, or folders of them")->required();
  app.add_option("--steps", steps, "Of each file, at least")->check(CLI::Range(1.0, 1e12));
  app.add_option("--seed", options.seed, "Of the rays");
  app.add_option("--threads", options.threads, "Threads")->check(CLI::Range(1, 256));
  app.add_flag("--in-background", in_background,
               "Hot scenes are specialised during the run, not all before it");
  app.add_option("--binding", options.binding, "The furthest that scenes are bound")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, Binding>{{"data", Binding::data},
                                         {"structure", Binding::structure},
                                         {"constants", Binding::constants}}));
  app.add_flag("--solids", options.solids, "Bound to data, with code for solids");
  app.add_option("--json", json_file, "Where to write a report");
  CLI11_PARSE(app, argc, argv);
  options.steps = static_cast<std::uint64_t>(steps);
  if (in_background) options.jit = JitMode::on;

  nlohmann::json report{{"files", nlohmann::json::array()}, {"refused", nlohmann::json::array()}};
  Counts totals;
  std::printf(
      "| file | rays | steps | in specialised scenes | bound so | bail_outs | stuck rays | "
      "differing | s |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  double seconds = 0;
  for (const std::string& file : gdml_files(files)) {
    try {
      const auto start = std::chrono::steady_clock::now();
      std::vector<Difference> differences;
      std::shared_ptr<const World> world;
      const Counts counts = run_file(file, options, differences, world);
      const double took =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      print_row(std::filesystem::path(file).stem(), counts, took);
      for (const Difference& d : differences) print_difference(*world, d);
      report["files"].push_back({{"file", file},
                                 {"rays", counts.rays},
                                 {"steps", counts.steps},
                                 {"in_specialised_scenes", counts.specialised},
                                 {"bound_so", counts.bound},
                                 {"bail_outs", counts.bail_outs},
                                 {"stuck", counts.stuck},
                                 {"differing", counts.differing}});
      totals += counts;
      seconds += took;
    } catch (const std::exception& e) {
      std::fprintf(stderr, "%s\n", e.what());
      report["refused"].push_back({{"file", file}, {"why", e.what()}});
    }
  }
  print_row("total", totals, seconds);
  if (!json_file.empty()) std::ofstream(json_file) << report.dump(1) << '\n';
  if (totals.steps == 0) return 2;
  return totals.differing == 0 ? 0 : 1;
}
