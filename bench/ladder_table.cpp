#include "bench/ladder_table.hpp"

#include <cmath>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "bench/cells.hpp"
#include "bench/floor.hpp"
#include "bench/ladder.hpp"
#include "bench/sampler.hpp"
#include "common/clock.hpp"
#include "common/statistics.hpp"

namespace navjit::bench {
namespace {

/// So few that a Sampler can hold all instructions of a line, at a few thousand for each step.
constexpr std::uint64_t steps_counted = 2000;
constexpr int repetitions = 15;

std::uint64_t transport_all(Navigator& navigator, const std::vector<Ray>& rays, double tolerance) {
  std::uint64_t steps = 0;
  for (const Ray& ray : rays) steps += transport(navigator, ray, tolerance).steps;
  return steps;
}

/// What one line of the table measures, on some rays. `run` makes all their steps.
struct Line {
  std::string name;
  std::function<void()> run;
};

/// The same steps in all ways, for the rays that it is made with.
struct Lines {
  Floor floor;
  Ladder ladder;
  std::vector<Line> all;

  Lines(const Geometry& geometry, Navigator& generic, Navigator& specialised,
        const std::vector<Ray>& rays)
      : floor(geometry, rays), ladder(geometry, rays) {
    const double tolerance = geometry.tolerance();
    all.push_back({"floor: one transformation, one distance, next point", [this] { floor.run(); }});
    for (int r = 0; r < rungs; ++r) {
      const Rung rung = static_cast<Rung>(r);
      all.push_back({std::string("+ ") + name_of(rung), [this, rung] { ladder.run(rung); }});
    }
    all.push_back({"+ the API: arguments, states, the start of rays; generic",
                   [&generic, &rays, tolerance] { transport_all(generic, rays, tolerance); }});
    all.push_back(
        {"specialised: all of these promises, for known scenes",
         [&specialised, &rays, tolerance] { transport_all(specialised, rays, tolerance); }});
  }
  Lines(const Lines&) = delete;
  Lines& operator=(const Lines&) = delete;
};

}  // namespace

void print_ladder(const Geometry& geometry, Runtime& specialised, const std::vector<Ray>& rays,
                  bool instructions, nlohmann::ordered_json& json) {
  RuntimeOptions off;
  off.jit = JitMode::off;
  Runtime runtime(specialised.share_world(), off);
  Navigator generic = runtime.navigator(), navigator = specialised.navigator();

  const Lines lines(geometry, generic, navigator, rays);
  const auto steps = static_cast<double>(lines.ladder.steps());
  std::vector<std::vector<double>> cycles(lines.all.size());
  for (const Line& line : lines.all) line.run();
  for (int r = 0; r < repetitions; ++r) {
    for (std::size_t i = 0; i < lines.all.size(); ++i) {
      const double before = common::cycles_per_ns();
      const double start = common::thread_ns();
      lines.all[i].run();
      const double ns = common::thread_ns() - start;
      cycles[i].push_back(ns * (before + common::cycles_per_ns()) / 2 / steps);
    }
  }

  std::vector<double> counted(lines.all.size(), unmeasured);
  if (instructions) {
    std::vector<Ray> few;
    std::uint64_t few_steps = 0;
    for (const Ray& ray : rays) {
      if (few_steps >= steps_counted) break;
      few.push_back(ray);
      few_steps += transport_all(generic, {ray}, geometry.tolerance());
    }
    const Lines small(geometry, generic, navigator, few);
    Sampler sampler;
    for (std::size_t i = 0; i < small.all.size(); ++i) {
      sampler.start_stepping();
      small.all[i].run();
      sampler.stop_stepping();
      // Where nothing can be stepped through, nothing is seen.
      const auto seen = static_cast<double>(sampler.take().size());
      if (seen > 0) counted[i] = each(seen, small.ladder.steps());
    }
  }

  std::printf("\n| promise | cycles/step | added |%s\n|---|--:|--:|%s\n",
              instructions ? " instructions/step | added |" : "", instructions ? "--:|--:|" : "");
  double last = 0, last_counted = 0;
  for (std::size_t i = 0; i < lines.all.size(); ++i) {
    const double now = common::quantile(cycles[i], 0.25);
    std::printf("| %s | %.0f | %+.0f |", lines.all[i].name.c_str(), now, now - last);
    if (instructions && std::isfinite(counted[i])) {
      std::printf(" %.0f | %+.0f |", counted[i], counted[i] - last_counted);
    } else if (instructions) {
      std::printf(" - | - |");
    }
    std::printf("\n");
    json["ladder"].push_back({{"promise", lines.all[i].name},
                              {"cycles_per_step", cycles[i]},
                              {"instructions_per_step", counted[i]}});
    last = now;
    last_counted = counted[i];
  }
}

}  // namespace navjit::bench
