// `navjit warmup`: what the JIT costs before it pays, and what it pays.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/accuracy/gnuplot.hpp"
#include "apps/commands.hpp"
#include "apps/read_detector.hpp"
#include "apps/warmup/experiment.hpp"
#include "apps/warmup/picture.hpp"
#include "apps/warmup/report.hpp"
#include "jit/compiler.hpp"

namespace navjit::apps {
namespace {

std::vector<warmup::Variant> variants_of(const WarmupOptions& options) {
  using warmup::Mode;
  std::vector<warmup::Variant> variants{{"off", Mode::off, {}}};
  for (const int opt : options.optimisations) {
    for (const Mode mode : {Mode::cold, Mode::cache, Mode::plugin}) {
      const std::string name = warmup::mode_name(mode);
      if (std::find(options.modes.begin(), options.modes.end(), name) == options.modes.end()) {
        continue;
      }
      const std::string level = std::to_string(opt);
      variants.push_back(
          {options.optimisations.size() > 1 ? name + " -O" + level : name, mode, {"--opt", level}});
    }
  }
  return variants;
}

void write(const std::string& path, const std::string& text) {
  std::ofstream out(path);
  out << text;
  if (!out.flush()) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace

int warmup(const WarmupOptions& options) {
  if (!options.picture.empty()) accuracy::check_picture(options.picture);
  if (!jit::has_compiler()) {
    throw std::runtime_error("this program was built without a compiler: nothing warms up");
  }
  read_detector(options.detector, options.setup);  // what is wrong with it is told at once
  warmup::ExperimentOptions experiment;
  experiment.program = std::filesystem::read_symlink("/proc/self/exe");
  experiment.words = options.words;
  experiment.detector = options.detector;
  experiment.setup = options.setup;
  experiment.variants = variants_of(options);
  experiment.repetitions = options.repetitions;
  experiment.seconds = options.seconds;
  experiment.prime_seconds = options.prime_seconds;
  const warmup::ExperimentReport report = warmup::run_experiment(experiment);
  warmup::print_table(report);
  if (!options.report.empty()) {
    nlohmann::ordered_json json{{"detector", options.detector},
                                {"threads", options.threads},
                                {"seconds", options.seconds},
                                {"repetitions", options.repetitions}};
    json.update(warmup::to_json(report));
    write(options.report, json.dump(1) + '\n');
  }
  if (!options.csv.empty()) write(options.csv, warmup::to_csv(report));
  if (!options.picture.empty()) {
    warmup::draw(report, std::filesystem::path(options.detector).filename(), options.picture);
  }
  if (!report.same_rays) throw std::runtime_error("runs differ in the steps of the same rays");
  return 0;
}

int warmup_run(const warmup::RunSetup& setup) {
  std::puts(to_text(run_once(setup)).c_str());
  return 0;
}

}  // namespace navjit::apps
