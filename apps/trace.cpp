// `navjit trace`: every step of every ray, as CSV.
#include <CLI/CLI.hpp>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <thread>

#include "apps/commands.hpp"
#include "apps/options/detector.hpp"
#include "apps/options/numbers.hpp"
#include "apps/options/runtime.hpp"
#include "apps/options/source.hpp"
#include "runtime/runtime.hpp"

namespace navjit::apps {
namespace {

struct Options {
  Detector detector;
  std::string rays;  ///< a file, or a number
  common::RaySource source;
  unsigned threads = 1;
  RuntimeOptions runtime;
  std::string out;  ///< empty: standard output
};

struct CloseFile {
  void operator()(FILE* file) const {
    if (file != stdout) std::fclose(file);
  }
};

/// Rays traced as one piece of work, and written as one.
constexpr std::size_t rays_per_chunk = 64;

std::string trace_ray(Navigator& navigator, const World& world, const Ray& ray,
                      std::size_t number) {
  std::string rows;
  char text[64];
  std::size_t step = 0;
  State last;
  const auto totals = transport(navigator, ray, world.tolerance, [&](const State& state, double l) {
    std::snprintf(text, sizeof text, "%.17g", l);
    rows += std::to_string(number) + ',' + std::to_string(step++) + ',' +
            world.volumes[state.volume()].name + ',' + text + '\n';
    last = state;
  });
  if (totals.stuck) {
    rows += std::to_string(number) + ',' + std::to_string(step) + ',' +
            (last.inside() ? world.volumes[last.volume()].name : "") + ",stuck\n";
  }
  return rows;
}

int trace(const Options& options) {
  Runtime runtime(read(options.detector), options.runtime);
  const World& world = runtime.world();
  const std::vector<Ray> rays = common::rays_of(options.rays, options.source, world);
  const std::unique_ptr<FILE, CloseFile> out(
      options.out.empty() ? stdout : std::fopen(options.out.c_str(), "w"));
  if (!out) throw std::runtime_error(options.out + ": " + std::strerror(errno));

  std::vector<std::string> chunks((rays.size() + rays_per_chunk - 1) / rays_per_chunk);
  std::atomic<std::size_t> next{0};
  std::atomic<std::uint64_t> differences{0};
  const auto work = [&] {
    Navigator navigator = runtime.navigator();
    for (std::size_t c; (c = next.fetch_add(1)) < chunks.size();) {
      const std::size_t last = std::min(rays.size(), (c + 1) * rays_per_chunk);
      for (std::size_t i = c * rays_per_chunk; i < last; ++i) {
        chunks[c] += trace_ray(navigator, world, rays[i], i);
      }
    }
    differences += navigator.counts().differences;
  };
  std::vector<std::jthread> threads;
  for (unsigned t = 1; t < options.threads; ++t) threads.emplace_back(work);
  work();
  threads.clear();

  std::fputs("ray,step,volume,length\n", out.get());
  for (const std::string& chunk : chunks) std::fputs(chunk.c_str(), out.get());
  if (std::fflush(out.get()) != 0 || std::ferror(out.get()) != 0) {
    throw std::runtime_error(options.out + ": " + std::strerror(errno));
  }
  if (differences > 0) {
    throw std::runtime_error(std::to_string(differences.load()) +
                             " steps differed from the generic navigator's");
  }
  return 0;
}

}  // namespace

void add_trace(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand("trace", "Write every step of every ray");
  add_detector(command, options->detector);
  command.add_option("--rays", options->rays, "CSV file of rays, or their number")
      ->required()
      ->option_text("FILE|N");
  add_seed(command, options->source.seed);
  command.add_option("--out", options->out, "CSV file (default: standard output)")
      ->option_text("FILE");
  add_threads(command, options->threads);
  add_runtime_options(command, options->runtime);
  command.callback([options, &action] { action = [options] { return trace(*options); }; });
}

}  // namespace navjit::apps
