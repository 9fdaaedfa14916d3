// Rays from far away cross a bore that is tiny compared with the way to it: they enter it, and
// leave it into what is beyond.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "geometry/navigation/generic.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

TEST(NarrowBore, OfAHyperbolicTubeIsCrossed) {
  for (const double bore : {0.1, 0.01, 0.002}) {
    World world;
    world.top = tests::add_volume(world, "world", make_box("world", 30000, 30000, 30000));
    tests::add_volume(world, "solid", make_hype("solid", bore, 20000, 0, 0.1, 20000));
    tests::place(world, world.top, 1, {0, 0, 0});
    finish(world);
    const Geometry geometry(std::make_shared<const World>(std::move(world)));
    const auto stack = std::make_unique<NavigationStack>();
    std::mt19937_64 random(3);
    for (int ray = 0; ray < 2000; ++ray) {
      // From where it is on, it passes the axis at an impact parameter of less than the bore.
      const double phi = tests::uniform(random, 0, 2 * M_PI),
                   far = tests::uniform(random, 1e3, 2e4);
      const double impact = bore * tests::uniform(random, -0.9, 0.9);
      const Vec3 across{std::cos(phi), std::sin(phi), 0}, beside{-across.y, across.x, 0};
      Vec3 v = -1 * across + Vec3{0, 0, tests::uniform(random, -0.1, 0.1)};
      v = 1 / std::sqrt(dot(v, v)) * v;
      Vec3 p = far * across + impact * beside;
      stack->depth = -1;
      generic::locate(geometry, *stack, p, v);
      double within = 0;
      int steps = 0;
      for (; stack->depth >= 0 && steps < 20; ++steps) {
        const bool in_solid = stack->levels[stack->depth].volume == 1;
        const double step =
            generic::step(geometry, *stack, p, v, std::numeric_limits<double>::infinity());
        within += in_solid ? step : 0;
        p += step * v;
      }
      ASSERT_EQ(stack->depth, -1);
      EXPECT_EQ(steps, 4) << "bore " << bore << ", ray " << ray;
      EXPECT_GT(within, far + 19999) << "bore " << bore << ", ray " << ray;
    }
  }
}

}  // namespace
}  // namespace navjit
