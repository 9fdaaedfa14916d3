// `navjit accuracy`: what each way of navigating costs, and how wrong it is.
#include "apps/accuracy/experiment.hpp"

#include <charconv>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/accuracy/gnuplot.hpp"
#include "apps/accuracy/picture.hpp"
#include "apps/accuracy/report.hpp"
#include "apps/commands.hpp"
#include "apps/read_detector.hpp"

namespace navjit::apps {
namespace {

std::vector<Ray> rays_of(const AccuracyOptions& options, const World& world) {
  std::uint64_t count = 0;
  const char* end = options.rays.data() + options.rays.size();
  const auto [at, error] = std::from_chars(options.rays.data(), end, count);
  if (error != std::errc{} || at != end) return read_rays(options.rays);
  if (count == 0) throw std::runtime_error("no rays are asked for; at least one is needed");
  std::vector<Ray> rays;
  for (std::uint64_t i = 0; i < count; ++i) rays.push_back(make_ray(options.source, world, i));
  return rays;
}

}  // namespace

int accuracy(const AccuracyOptions& options) {
  if (!options.picture.empty()) accuracy::check_picture(options.picture);
  const auto world = read_detector(options.detector, options.setup);
  accuracy::ExperimentOptions experiment;
  experiment.rays = rays_of(options, *world);
  experiment.seed = options.source.seed;
  experiment.threads = options.threads;
  experiment.repetitions = options.repetitions;
  experiment.boundaries = options.boundaries;
  experiment.geometry = options.geometry;
  if (options.vecgeom != "off") {
    std::optional<std::string> program = options.vecgeom.empty()
                                             ? accuracy::VecGeom::beside_this_program()
                                             : std::optional(options.vecgeom);
    if (program) {
      const std::string& detector =
          options.vecgeom_detector.empty() ? options.detector : options.vecgeom_detector;
      experiment.vecgeom = {*program, detector, options.vecgeom_navigator, options.vecgeom_seconds};
    } else {
      std::fprintf(stderr, "navjit: without VecGeom: there is no vecgeom_trace beside navjit\n");
    }
  }
  const accuracy::ExperimentReport report = accuracy::run_experiment(world, experiment);
  accuracy::print_tables(*world, report, options.scenes);
  if (!options.report.empty()) {
    std::ofstream out(options.report);
    out << accuracy::to_json(*world, options.detector, report).dump(2) << '\n';
    if (!out.flush()) throw std::runtime_error(options.report + ": cannot be written");
  }
  if (!options.picture.empty()) {
    accuracy::draw(report, std::filesystem::path(options.detector).filename(), options.picture);
  }
  // The levels of navjit have to be right; how VecGeom fares is a result.
  for (const accuracy::EngineReport& engine : report.engines) {
    if (engine.name == "VecGeom") continue;
    const accuracy::EngineFigures& f = engine.figures;
    if (f.stuck + f.lost + f.all.wrong_volume + f.all.wrong_end + f.beyond_bound > 0) return 1;
    if (engine.name == "exact" && f.equal != f.made) return 1;
  }
  return 0;
}

}  // namespace navjit::apps
