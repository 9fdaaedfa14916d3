// Which rays a benchmark takes through a detector.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "bench/ranges.hpp"
#include "common/rays.hpp"

namespace navjit::bench {

struct RayOptions {
  std::string file;
  std::uint64_t count = 2000, seed = 1;
  bool forward = false;
  std::string aim;
};

inline void add_ray_options(CLI::App& app, RayOptions& options) {
  app.add_option("--rays", options.file, "CSV file of rays (default: random ones)");
  app.add_option("--count", options.count, "random rays")->check(range_of_counts());
  app.add_option("--seed", options.seed, "of random rays");
  app.add_flag("--forward", options.forward, "random rays from the origin with eta 2..5");
  app.add_option("--aim", options.aim, "random rays through this volume's boxes, or auto");
}

inline std::vector<Ray> rays_of(const RayOptions& options, const World& world) {
  if (!options.file.empty()) return common::read_rays(options.file);
  common::RaySource source;
  source.seed = options.seed;
  source.aim = options.aim;
  if (options.forward) {
    source.origin = Vec3{0, 0, 0};
    source.eta = {2, 5};
  }
  const common::RayMaker maker(world, source);
  std::vector<Ray> rays;
  rays.reserve(options.count);
  for (std::uint64_t i = 0; i < options.count; ++i) rays.push_back(maker.ray(i));
  return rays;
}

/// The same; if there is nothing to aim at, isotropic rays over the world.
inline std::vector<Ray> rays_of_any(RayOptions options, const World& world) {
  try {
    return rays_of(options, world);
  } catch (const Error&) {
    if (options.aim.empty()) throw;
    options.aim.clear();
    return rays_of(options, world);
  }
}

}  // namespace navjit::bench
