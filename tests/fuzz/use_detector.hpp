// Does what a simulation does with a file: reads it, prepares it, and sends rays through it.
#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <random>

#include "geometry/gdml/read_world.hpp"
#include "geometry/navigation/generic.hpp"

namespace navjit::fuzz {

/// Limits so low that whatever keeps to them is done in a fraction of a second.
inline GdmlOptions tight_options() {
  GdmlOptions options;
  options.limits.max_bytes = 1 << 20;
  options.limits.max_elements = 20'000;
  options.limits.max_loop_iterations = 20'000;
  options.limits.max_placements = 20'000;
  options.limits.max_planes = 100;
  options.limits.max_solid_depth = 50;
  options.limits.max_solid_parts = 200;
  return options;
}

/// Reads the world and makes some hundred steps. False if the file is refused. Aborts on answers
/// that no detector can give: a step that is negative or no number, a refusal of several lines.
template <class Read>
bool use_world(Read&& read) {
  const auto check = [](bool condition, const char* what) {
    if (condition) return;
    std::fprintf(stderr, "use_detector: %s\n", what);
    std::abort();
  };
  std::shared_ptr<const World> world;
  try {
    world = read();
  } catch (const Error& error) {
    const std::string message = error.what();
    check(!message.empty() && message.find('\n') == std::string::npos, "not one line");
    return false;
  }
  const Geometry geometry(world);
  const Extent box = world->volumes[world->top].solid.extent;
  std::mt19937_64 random(3);
  const auto between = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
  };
  const auto stack = std::make_unique<NavigationStack>();
  for (int ray = 0; ray < 8; ++ray) {
    Vec3 p{between(box.min.x, box.max.x), between(box.min.y, box.max.y),
           between(box.min.z, box.max.z)};
    Vec3 v{between(-1, 1), between(-1, 1), between(-1, 1)};
    const double norm = std::hypot(v.x, v.y, v.z);
    v = {v.x / norm, v.y / norm, v.z / norm};
    generic::locate(geometry, *stack, p, v);
    for (int step = 0; step < 60 && stack->depth >= 0; ++step) {
      check(generic::safety(geometry, *stack, p) >= 0, "a negative safety");
      const double length = generic::step(geometry, *stack, p, v, INFINITY);
      check(length >= 0, "a step that is negative or not a number");
      p = {p.x + length * v.x, p.y + length * v.y, p.z + length * v.z};
    }
  }
  return true;
}

/// The same with a GDML file.
inline bool use_detector(const std::filesystem::path& path) {
  return use_world(
      [&] { return std::make_shared<const World>(read_world(path, tight_options())); });
}

}  // namespace navjit::fuzz
