// `navjit trace`: every step of every ray, as CSV.
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <thread>

#include "apps/commands.hpp"
#include "apps/read_detector.hpp"
#include "runtime/runtime.hpp"

namespace navjit::apps {
namespace {

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

std::vector<Ray> rays_of(const TraceOptions& options, const World& world) {
  std::uint64_t count = 0;
  const char* end = options.rays.data() + options.rays.size();
  const auto [at, error] = std::from_chars(options.rays.data(), end, count);
  if (error != std::errc{} || at != end) return read_rays(options.rays);
  RaySource source;
  source.seed = options.seed;
  std::vector<Ray> rays;
  for (std::uint64_t i = 0; i < count; ++i) rays.push_back(make_ray(source, world, i));
  return rays;
}

}  // namespace

int trace(const TraceOptions& options) {
  Runtime runtime(read_detector(options.detector, options.setup), options.runtime);
  const World& world = runtime.world();
  const std::vector<Ray> rays = rays_of(options, world);
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

}  // namespace navjit::apps
