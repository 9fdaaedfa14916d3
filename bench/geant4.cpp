// Many detectors, measured beside Geant4's own navigator: straight rays and particles that scatter,
// with navjit generic and specialised; the same work in one process, in turn, by processor time. It
// also compares the rays step by step. Each detector has a process of its own: Geant4 holds only
// one, and ends the process at a file that it cannot read.
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>

#include "bench/agreement.hpp"
#include "bench/flights.hpp"
#include "bench/peers/geant4_peer.hpp"
#include "bench/ranges.hpp"
#include "bench/ray_options.hpp"
#include "bench/shower.hpp"
#include "bench/warm_up.hpp"
#include "common/clock.hpp"
#include "common/statistics.hpp"
#include "geometry/gdml/read_world.hpp"

namespace {

using namespace navjit;

constexpr double same_place = 1e-6;  // mm
/// Fewer steps are no measurement.
constexpr std::uint64_t fewest_steps = 1000;

struct Options {
  bench::RayOptions rays;
  std::uint64_t primaries = 300;
  int repetitions = 3;
  double warm_up = 2;
  double patience = 300;
  bool show = false;
};

/// What is printed for a detector; its process hands it over as bytes.
struct Row {
  std::uint64_t rays, differ, steps;
  double ns[2];       ///< Geant4's, for each step; straight rays, and particles that scatter
  double generic[2];  ///< how many times as fast navjit is
  double specialised[2];
  char failure[160];
};

std::string without_suffix(std::string name) {
  constexpr std::string_view reflected = "_refl";
  if (name.ends_with(reflected)) name.resize(name.size() - reflected.size());
  return name;
}

std::vector<bench::Passed> trace(Navigator& navigator, const World& world, const Ray& ray) {
  std::vector<bench::Passed> steps;
  transport(navigator, ray, world.tolerance, [&](const State& state, double length) {
    steps.push_back({without_suffix(world.volumes[state.volume()].name), length});
  });
  return steps;
}

std::vector<bench::Passed> trace(const peers::Geant4Peer& peer, const Ray& ray) {
  std::vector<bench::Passed> steps;
  for (const auto& segment : peer.trace(ray)) {
    steps.push_back({without_suffix(segment.volume), segment.length});
  }
  return steps;
}

void show(const Ray& ray, std::span<const bench::Passed> geant4,
          std::span<const bench::Passed> own) {
  std::fprintf(stderr, "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", ray.position.x, ray.position.y,
               ray.position.z, ray.direction.x, ray.direction.y, ray.direction.z);
  double at[2] = {0, 0};
  for (std::size_t i = 0; i < std::max(geant4.size(), own.size()); ++i) {
    const bench::Passed none{"-", 0};
    const bench::Passed& a = i < geant4.size() ? geant4[i] : none;
    const bench::Passed& b = i < own.size() ? own[i] : none;
    at[0] += a.length, at[1] += b.length;
    std::fprintf(stderr, "  %-40s %.9f   %-40s %.9f\n", a.volume.c_str(), at[0], b.volume.c_str(),
                 at[1]);
  }
}

struct Engine {
  Runtime runtime;
  Navigator navigator;
  Engine(const std::shared_ptr<const World>& world, JitMode mode)
      : runtime(world,
                [=] {
                  RuntimeOptions options;
                  options.jit = mode;
                  return options;
                }()),
        navigator(runtime.navigator()) {}
};

Row measure(const std::string& file, const Options& options) {
  Row row{};
  const auto world = std::make_shared<const World>(read_world(file));
  const std::vector<Ray> rays = bench::rays_of_any(options.rays, *world);
  const peers::Geant4Peer peer(file);
  Engine generic(world, JitMode::off), made(world, JitMode::on);
  row.rays = rays.size();
  std::vector<Ray> alike;
  for (const Ray& ray : rays) {
    const auto theirs = trace(peer, ray), own = trace(generic.navigator, *world, ray);
    row.steps += own.size();
    if (bench::agree(theirs, own, same_place)) {
      alike.push_back(ray);
    } else {
      if (options.show && row.differ == 0) show(ray, theirs, own);
      ++row.differ;
    }
  }
  if (row.steps < fewest_steps) throw std::runtime_error("too few steps to be measured");
  // Where the engines disagree they would be timed on different work.
  if (alike.empty()) throw std::runtime_error("no ray is as Geant4's");
  auto primaries = alike;
  primaries.resize(std::min<std::size_t>(primaries.size(), options.primaries));
  const auto flights = bench::shower(generic.runtime, primaries, {});
  if (flights.empty()) throw std::runtime_error("no primary starts within the world");
  double safeties = 0;
  std::uint64_t made_steps[2]{};
  const auto run = [&](int engine, int kind) {
    if (engine == 0) {
      made_steps[kind] = kind == 0 ? peer.transport(alike) : peer.fly(flights, safeties);
      return;
    }
    Navigator& navigator = engine == 1 ? generic.navigator : made.navigator;
    if (kind == 0) {
      for (const Ray& ray : alike) transport(navigator, ray, world->tolerance);
    } else {
      bench::follow(navigator, flights, bench::Asked::whole);
    }
  };
  bench::warm_up(made.runtime, options.warm_up, [&] {
    run(2, 0);
    run(2, 1);
  });
  std::vector<double> ns[3][2];
  for (int r = 0; r < options.repetitions; ++r) {
    for (int kind : {0, 1}) {
      for (int engine : {0, 1, 2}) {
        const double start = common::thread_ns();
        int times = 0;
        do {
          run(engine, kind);
          ++times;
        } while (common::thread_ns() - start < 5e7);
        ns[engine][kind].push_back((common::thread_ns() - start) / times);
      }
    }
  }
  for (int kind : {0, 1}) {
    row.ns[kind] = common::summarise(ns[0][kind]).median / static_cast<double>(made_steps[kind]);
    row.generic[kind] = common::ratio(ns[0][kind], ns[1][kind]).median;
    row.specialised[kind] = common::ratio(ns[0][kind], ns[2][kind]).median;
  }
  return row;
}

/// Measures in a process of its own, which may die or hang.
Row measure_apart(const std::string& file, const Options& options) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe can be made");
  std::fflush(stdout);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process can be made");
  if (child == 0) {
    close(ends[0]);
    alarm(static_cast<unsigned>(options.patience));
    if (std::freopen("/dev/null", "w", stdout) == nullptr) _exit(1);  // Geant4 prints much
    if (!options.show && std::freopen("/dev/null", "w", stderr) == nullptr) _exit(1);
    Row row{};
    try {
      row = measure(file, options);
    } catch (const std::exception& error) {
      std::snprintf(row.failure, sizeof row.failure, "%s", error.what());
    }
    const bool written = write(ends[1], &row, sizeof row) == sizeof row;
    _exit(written ? 0 : 1);  // Geant4's own exit may fail on what is left
  }
  close(ends[1]);
  Row row{};
  const bool whole = read(ends[0], &row, sizeof row) == sizeof row;
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (!whole) {
    row = {};
    const bool by_signal = WIFSIGNALED(status);
    std::snprintf(row.failure, sizeof row.failure, "its process ended with %s %d (see --show)",
                  by_signal ? "signal" : "status",
                  by_signal ? WTERMSIG(status) : WEXITSTATUS(status));
  }
  return row;
}

void print_summary(const char* what, const std::vector<Row>& rows,
                   const std::function<double(std::vector<double>)>& of) {
  std::printf("| %s | | | ", what);
  for (int kind : {0, 1}) {
    std::vector<double> generic, specialised;
    for (const Row& row : rows) {
      generic.push_back(row.generic[kind]);
      specialised.push_back(row.specialised[kind]);
    }
    std::printf("| | %.2f | %.2f ", of(generic), of(specialised));
  }
  std::printf("|\n");
}

double geometric_mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += std::log(v);
  return std::exp(sum / static_cast<double>(values.size()));
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app{"Many detectors beside Geant4's own navigator"};
  std::vector<std::string> detectors;
  Options options;
  options.rays.aim = "auto";
  app.add_option("detectors", detectors, "GDML files")->required();
  bench::add_ray_options(app, options.rays);
  app.add_option("--primaries", options.primaries, "of the particles that scatter")
      ->check(bench::range_of_counts());
  app.add_option("--repetitions", options.repetitions, "of each engine, in turn")
      ->check(bench::range_of_repetitions());
  app.add_option("--warm-up", options.warm_up, "seconds of specialisation before, at least")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--patience", options.patience, "seconds for a detector")
      ->check(CLI::Range(1.0, 86400.0));
  app.add_flag("--show", options.show, "the first ray that differs; what Geant4 has to say");
  CLI11_PARSE(app, argc, argv);
  std::printf(
      "| detector | rays that differ | steps | straight: Geant4, ns/step | navjit generic, times "
      "as fast | specialised | scattering: Geant4, ns/step | generic | specialised |\n"
      "|---|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  std::vector<Row> rows;
  std::uint64_t rays = 0, differ = 0;
  for (const std::string& detector : detectors) {
    const Row row = measure_apart(detector, options);
    const std::string name = std::filesystem::path(detector).stem();
    if (row.failure[0] != '\0') {
      std::printf("| %s | %s |\n", name.c_str(), row.failure);
      continue;
    }
    std::printf("| %s | %llu of %llu | %llu | %.0f | %.2f | %.2f | %.0f | %.2f | %.2f |\n",
                name.c_str(), static_cast<unsigned long long>(row.differ),
                static_cast<unsigned long long>(row.rays),
                static_cast<unsigned long long>(row.steps), row.ns[0], row.generic[0],
                row.specialised[0], row.ns[1], row.generic[1], row.specialised[1]);
    std::fflush(stdout);
    rays += row.rays;
    differ += row.differ;
    rows.push_back(row);
  }
  if (rows.empty()) return 1;
  print_summary("**mean**", rows, geometric_mean);
  print_summary("**median**", rows, [](std::vector<double> v) { return common::quantile(v, 0.5); });
  print_summary("**worst**", rows, [](std::vector<double> v) { return common::quantile(v, 0); });
  std::printf("\n%zu detectors; %llu of %llu rays differ\n", rows.size(),
              static_cast<unsigned long long>(differ), static_cast<unsigned long long>(rays));
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "geant4: %s\n", error.what());
  return 1;
}
