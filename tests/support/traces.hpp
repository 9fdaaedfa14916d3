// Rays through worlds, every step kept, to be compared bit for bit.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "runtime/runtime.hpp"
#include "runtime/transport.hpp"
#include "tests/support/worlds.hpp"

namespace navjit::tests {

struct Row {
  TouchableId touchable;
  double length;
};

inline bool same_bits(const std::vector<Row>& a, const std::vector<Row>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].touchable != b[i].touchable ||
        std::memcmp(&a[i].length, &b[i].length, sizeof(double)) != 0) {
      return false;
    }
  }
  return true;
}

inline std::vector<Row> trace(Navigator& navigator, const Ray& ray, double tolerance) {
  std::vector<Row> rows;
  const RayTotals totals = transport(navigator, ray, tolerance, [&](const State& s, double length) {
    rows.push_back({s.touchable(), length});
  });
  EXPECT_FALSE(totals.stuck);
  return rows;
}

inline std::vector<Ray> rays_through(const World& world, std::uint64_t seed, int count) {
  std::mt19937_64 random(seed);
  const Extent& e = world.volumes[world.top].solid.extent;
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) {
    Ray ray{{uniform(random, e.min.x, e.max.x), uniform(random, e.min.y, e.max.y),
             uniform(random, e.min.z, e.max.z)},
            random_direction(random)};
    // Some along the axes, through rounded coordinates: faces and edges are hit exactly.
    if (i % 4 == 0) {
      ray.direction = i % 8 == 0 ? Vec3{0, 0, 1} : Vec3{-1, 0, 0};
      ray.position = {std::round(ray.position.x), std::round(ray.position.y),
                      std::round(ray.position.z)};
    }
    rays.push_back(ray);
  }
  return rays;
}

/// For small worlds and runs: everything is specialised early.
inline RuntimeOptions eager_options(JitMode jit) {
  RuntimeOptions o;
  o.jit = jit;
  o.specialiser.compile_weight = 1e-6;
  o.specialiser.min_steps = 200;
  o.specialiser.optimisation = 1;
  o.specialiser.keep_only_faster = false;
  return o;
}

}  // namespace navjit::tests
