// Questions that follow no track: where a point is, where one is after a displacement, a step from
// any touchable, tracks that take turns. A program that asks nothing else, with navjit's generic
// and its specialised navigators, in one process, in turn.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <random>

#include "bench/ray_options.hpp"
#include "bench/warm_up.hpp"
#include "common/clock.hpp"
#include "common/statistics.hpp"
#include "geometry/gdml/read_world.hpp"
#include "geometry/model/random.hpp"

namespace {

using namespace navjit;

/// Somewhere on a step of a ray.
struct Place {
  State state{};
  Vec3 point{}, direction{}, displaced{};
  std::size_t ray = 0;
};

/// One place on each step, in the order of the rays.
std::vector<Place> places_on(Navigator& navigator, const std::vector<Ray>& rays,
                             double displacement, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<Place> places;
  for (std::size_t ray = 0; ray < rays.size(); ++ray) {
    Vec3 at = rays[ray].position;
    const Vec3 along = rays[ray].direction;
    int left = 10'000;
    for (State state = navigator.locate(at, along); state.inside() && left-- > 0;) {
      const Step step = navigator.step(state, at, along);
      const Vec3 point = at + uniform(random, 0, step.length) * along;
      places.push_back({state, point, along, point + displacement * unit_vector(random), ray});
      at = at + step.length * along;
      state = step.next;
    }
  }
  return places;
}

using Ask = std::function<double(Navigator&, const Place&)>;

struct Asked {
  std::string name;
  std::vector<Place> places;
  Ask ask;
};

double number(const State& state) { return state.inside() ? 1.0 : 0.0; }

std::vector<Asked> questions_at(const std::vector<Place>& places, std::size_t tracks,
                                std::uint64_t seed) {
  std::vector<Place> anywhere = places;
  std::shuffle(anywhere.begin(), anywhere.end(), std::mt19937_64(seed));
  // The first steps of so many rays, then their second ones, and so on.
  std::vector<Place> in_turn;
  for (std::size_t from = 0; from < places.size();) {
    std::vector<std::size_t> begins;
    std::size_t to = from;
    for (; to < places.size(); ++to) {
      if (to > from && places[to].ray == places[to - 1].ray) continue;
      if (begins.size() == tracks) break;
      begins.push_back(to);
    }
    for (std::size_t n = 0, before = in_turn.size() + 1; before != in_turn.size(); ++n) {
      before = in_turn.size();
      for (const std::size_t begin : begins) {
        if (begin + n < to && places[begin + n].ray == places[begin].ray) {
          in_turn.push_back(places[begin + n]);
        }
      }
    }
    from = to;
  }
  const Ask step = [](Navigator& navigator, const Place& p) {
    return navigator.step(p.state, p.point, p.direction).length;
  };
  return {{"locate, any point", anywhere,
           [](Navigator& navigator, const Place& p) {
             return number(navigator.locate(p.point, p.direction));
           }},
          {"relocate, displaced", places,
           [](Navigator& navigator, const Place& p) {
             return number(navigator.relocate(p.state, p.displaced, p.direction));
           }},
          {"step, any state", std::move(anywhere), step},
          {"step, tracks in turn", std::move(in_turn), step}};
}

/// All of them; the sum of the answers.
double ask_all(Navigator& navigator, const Asked& asked) {
  double sum = 0;
  for (const Place& place : asked.places) sum += asked.ask(navigator, place);
  return sum;
}

struct Gain {
  double generic_ns, specialised_ns, ratio;
};

Gain measure(const std::shared_ptr<const World>& world, const Asked& asked, int repetitions,
             double warm_s) {
  const auto mode = [](JitMode jit) {
    RuntimeOptions options;
    options.jit = jit;
    return options;
  };
  Runtime generic(world, mode(JitMode::off)), specialised(world, mode(JitMode::on));
  Navigator navigators[] = {generic.navigator(), specialised.navigator()};
  bench::warm_up(specialised, warm_s, [&] { ask_all(navigators[1], asked); });
  std::vector<double> ns[2];
  double sums[2] = {0, 0};
  for (int r = -1; r < repetitions; ++r) {  // the first one is not counted
    for (int which : {0, 1}) {
      const double start = common::thread_ns();
      sums[which] = ask_all(navigators[which], asked);
      if (r >= 0) ns[which].push_back(common::thread_ns() - start);
    }
  }
  if (sums[0] != sums[1]) throw Error("the navigators do not agree: " + asked.name);
  const auto each = static_cast<double>(asked.places.size());
  return {common::summarise(ns[0]).median / each, common::summarise(ns[1]).median / each,
          common::ratio(ns[0], ns[1]).median};
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app{"Questions that follow no track: navjit generic and specialised"};
  std::vector<std::string> detectors;
  bench::RayOptions rays;
  rays.count = 3000;
  rays.aim = "auto";
  int repetitions = 7;
  double displacement = 1, warm_s = 2;
  std::size_t tracks = 64;
  app.add_option("detectors", detectors, "GDML files")->required();
  bench::add_ray_options(app, rays);
  app.add_option("--repetitions", repetitions, "of each navigator, in turn")
      ->check(CLI::PositiveNumber);
  app.add_option("--displacement", displacement, "mm")->check(CLI::NonNegativeNumber);
  app.add_option("--tracks", tracks, "that take turns")->check(CLI::PositiveNumber);
  app.add_option("--warm-up", warm_s, "s of processor time for each question")
      ->check(CLI::NonNegativeNumber);
  bool verbose = false;
  app.add_flag("--verbose", verbose, "log what is specialised, and what is judged how");
  CLI11_PARSE(app, argc, argv);
  spdlog::set_default_logger(spdlog::stderr_color_mt("navjit"));
  spdlog::set_level(verbose ? spdlog::level::debug : spdlog::level::warn);
  std::printf(
      "| detector | question | generic, ns | specialised, ns | speed-up |\n"
      "|---|---|--:|--:|--:|\n");
  std::vector<std::pair<std::string, std::vector<double>>> gains;
  for (const std::string& detector : detectors) {
    const auto world = std::make_shared<const World>(read_world(detector));
    RuntimeOptions off;
    off.jit = JitMode::off;
    Runtime runtime(world, off);
    Navigator navigator = runtime.navigator();
    const std::vector<Place> places =
        places_on(navigator, bench::rays_of_any(rays, *world), displacement, rays.seed);
    if (places.empty()) throw Error(detector + ": no ray makes a step");
    for (const Asked& asked : questions_at(places, tracks, rays.seed)) {
      const Gain gain = measure(world, asked, repetitions, warm_s);
      std::printf("| %s | %s | %.1f | %.1f | %.2f |\n",
                  std::filesystem::path(detector).stem().c_str(), asked.name.c_str(),
                  gain.generic_ns, gain.specialised_ns, gain.ratio);
      std::fflush(stdout);
      auto of = std::find_if(gains.begin(), gains.end(),
                             [&](const auto& known) { return known.first == asked.name; });
      if (of == gains.end()) of = gains.insert(gains.end(), {asked.name, {}});
      of->second.push_back(gain.ratio);
    }
  }
  std::printf("\n");
  for (const auto& [name, ratios] : gains) {
    double logs = 0;
    for (const double ratio : ratios) logs += std::log(ratio);
    std::printf("%s: %.2f times on average, %.2f at worst\n", name.c_str(),
                std::exp(logs / static_cast<double>(ratios.size())),
                *std::min_element(ratios.begin(), ratios.end()));
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "questions: %s\n", error.what());
  return 1;
}
