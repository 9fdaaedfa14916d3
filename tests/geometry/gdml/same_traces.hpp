// Compares two worlds that should mean the same, by rays.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "geometry/navigation/generic.hpp"
#include "tests/support/worlds.hpp"

namespace navjit::testing {

struct NamedStep {
  std::string volume;
  double length;
};

/// The steps of a ray, except those of no length. Names of volumes are cut off at the first
/// underscore.
inline std::vector<NamedStep> named_trace(const Geometry& geometry, Vec3 point, const Vec3& v) {
  const auto stack = std::make_unique<NavigationStack>();
  generic::locate(geometry, *stack, point, v);
  std::vector<NamedStep> steps;
  for (int made = 0; stack->depth >= 0; ++made) {
    EXPECT_LT(made, 10000);
    if (made == 10000) break;
    const VolumeId volume = stack->levels[stack->depth].volume;
    const double length = generic::step(geometry, *stack, point, v, INFINITY);
    point += length * v;
    std::string name = geometry.world().volumes[volume].name;
    name = name.substr(0, name.find('_'));
    if (length < 1e-9) continue;
    steps.push_back({name, length});
  }
  return steps;
}

/// Compares rays from all over the world volume's box.
inline void expect_same_traces(World first, World second, int rays = 300) {
  const Extent box = first.volumes[first.top].solid.extent;
  const Geometry a(std::make_shared<const World>(std::move(first)));
  const Geometry b(std::make_shared<const World>(std::move(second)));
  std::mt19937_64 random(5);
  std::size_t compared = 0;
  for (int ray = 0; ray < rays; ++ray) {
    const Vec3 p{tests::uniform(random, box.min.x, box.max.x),
                 tests::uniform(random, box.min.y, box.max.y),
                 tests::uniform(random, box.min.z, box.max.z)};
    const Vec3 v = tests::random_direction(random);
    const auto x = named_trace(a, p, v), y = named_trace(b, p, v);
    ASSERT_EQ(x.size(), y.size()) << "ray " << ray;
    for (std::size_t i = 0; i < x.size(); ++i) {
      EXPECT_EQ(x[i].volume, y[i].volume) << "ray " << ray;
      EXPECT_NEAR(x[i].length, y[i].length, 1e-8) << "ray " << ray;
    }
    compared += x.size();
  }
  EXPECT_GT(compared, 0u);
}

/// The volume of all daughters together.
inline double daughters_capacity(const World& world) {
  double sum = 0;
  for (const Placement& p : world.volumes[world.top].daughters) {
    sum += capacity(world.volumes[p.volume].solid);
  }
  return sum;
}

}  // namespace navjit::testing
