// Questions that follow no track: where a point is, where it is after a displacement, a step from
// any touchable, tracks that take turns, with one navigator or in a basket. This times programs
// that ask nothing else, with navjit's generic and specialised navigators, in one process, in turn.
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

#include "bench/ranges.hpp"
#include "bench/ray_options.hpp"
#include "bench/warm_up.hpp"
#include "common/clock.hpp"
#include "common/statistics.hpp"
#include "geometry/gdml/read_world.hpp"
#include "geometry/model/random.hpp"

namespace {

using namespace navjit;

/// A place on a step of a ray.
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

/// What one call of Basket::step gets: the next steps of tracks that keep their places in the
/// arrays. Tracks that have left the world stay outside.
struct Row {
  std::vector<State> state;
  std::vector<double> x, y, z, u, v, w;

  void add(const Place& place, bool ended) {
    state.push_back(ended ? State{} : place.state);
    x.push_back(place.point.x), y.push_back(place.point.y), z.push_back(place.point.z);
    u.push_back(place.direction.x), v.push_back(place.direction.y), w.push_back(place.direction.z);
  }
};

/// The steps of so many rays at once: when a ray has ended, the next takes its place.
std::vector<Row> rows_of(const std::vector<Place>& places, std::size_t tracks) {
  std::vector<std::size_t> at(tracks, places.size());  // the next step of each track
  std::size_t next = 0;                                // where the next ray begins
  const auto begin = [&](std::size_t& track) {
    track = next;
    while (next < places.size() && places[next].ray == places[track].ray) ++next;
  };
  for (std::size_t& track : at) begin(track);
  std::vector<Row> rows;
  for (bool any = true; any;) {
    Row& row = rows.emplace_back();
    any = false;
    for (std::size_t& track : at) {
      const bool ended = track == places.size();
      row.add(ended ? Place{} : places[track], ended);
      if (ended) continue;
      any = true;
      const std::size_t ray = places[track].ray;
      if (++track == places.size() || places[track].ray != ray) begin(track);
    }
  }
  rows.pop_back();  // a row in which all tracks have ended
  return rows;
}

/// Asks at all places in turn; returns the sum of the answers.
using AskAll = std::function<double(Runtime&, Navigator&)>;

struct Asked {
  std::string name;
  std::size_t count;
  AskAll ask_all;
};

template <class Ask>
Asked one_by_one(std::string name, std::vector<Place> places, const Ask& ask) {
  const std::size_t count = places.size();
  return {std::move(name), count,
          [places = std::move(places), ask](Runtime&, Navigator& navigator) {
            double sum = 0;
            for (const Place& place : places) sum += ask(navigator, place);
            return sum;
          }};
}

double step_of(Navigator& navigator, const Place& p) {
  return navigator.step(p.state, p.point, p.direction).length;
}

std::vector<Asked> questions_at(const std::vector<Place>& places, std::size_t tracks,
                                std::uint64_t seed) {
  std::vector<Place> anywhere = places, in_turn;
  std::shuffle(anywhere.begin(), anywhere.end(), std::mt19937_64(seed));
  std::vector<Row> rows = rows_of(places, tracks);
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.state.size(); ++i) {
      if (!row.state[i].inside()) continue;
      in_turn.push_back(
          {row.state[i], {row.x[i], row.y[i], row.z[i]}, {row.u[i], row.v[i], row.w[i]}});
    }
  }
  const auto found = [](const State& state) { return state.inside() ? 1.0 : 0.0; };
  const auto by_basket = [rows = std::move(rows), tracks](Runtime& runtime, Navigator&) {
    Basket basket = runtime.basket(tracks);
    std::vector<double> length(tracks);
    std::vector<std::uint8_t> boundary(tracks);
    std::vector<State> next(tracks);
    double sum = 0;
    for (const Row& r : rows) {
      const std::size_t n = r.state.size();
      basket.step(
          {r.state, r.x, r.y, r.z, r.u, r.v, r.w},
          {std::span(length).first(n), std::span(boundary).first(n), std::span(next).first(n)});
      for (std::size_t i = 0; i < n; ++i) sum += length[i];
    }
    return sum;
  };
  return {one_by_one("locate, any point", anywhere,
                     [found](Navigator& navigator, const Place& p) {
                       return found(navigator.locate(p.point, p.direction));
                     }),
          one_by_one("relocate, displaced", places,
                     [found](Navigator& navigator, const Place& p) {
                       return found(navigator.relocate(p.state, p.displaced, p.direction));
                     }),
          one_by_one("step, any state", anywhere, step_of),
          one_by_one("step, tracks in turn", std::move(in_turn), step_of),
          {"step, tracks in a basket", places.size(), by_basket}};
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
  Runtime* runtimes[] = {&generic, &specialised};
  bench::warm_up(specialised, warm_s, [&] { asked.ask_all(specialised, navigators[1]); });
  std::vector<double> ns[2];
  double sums[2] = {0, 0};
  for (int r = -1; r < repetitions; ++r) {  // the first one is not counted
    for (int which : {0, 1}) {
      const double start = common::thread_ns();
      sums[which] = asked.ask_all(*runtimes[which], navigators[which]);
      if (r >= 0) ns[which].push_back(common::thread_ns() - start);
    }
  }
  if (sums[0] != sums[1]) throw Error("the navigators do not agree: " + asked.name);
  const auto each = static_cast<double>(asked.count);
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
      ->check(bench::range_of_repetitions());
  app.add_option("--displacement", displacement, "mm")->check(CLI::NonNegativeNumber);
  app.add_option("--tracks", tracks, "that take turns")->check(bench::range_of_counts());
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
