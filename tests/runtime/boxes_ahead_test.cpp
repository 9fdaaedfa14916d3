// The boxes that a straight ray meets in a mother are looked for once. Later steps of the ray there
// have the answers of the generic navigator, which remembers nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "tests/runtime/bound_world.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// Overlapping boxes and tubes in a hall, which also holds a turned hall of them: another mother of
/// many, at another depth.
World halls(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 20, 20, 20));
  const VolumeId inner = tests::add_volume(world, "inner", make_tube("inner", 0, 8, 8, 0, 7));
  const auto fill = [&](VolumeId mother, int count, double half) {
    for (int i = 0; i < count; ++i) {
      const std::string name = std::to_string(mother) + "_" + std::to_string(i);
      const Solid solid = i % 2 == 0 ? make_box(name, 3, 1, 0.5 + i % 3)
                                     : make_tube(name, 0.5, 1.5, 1.0 + i % 2, 0, 7);
      tests::place(world, mother, tests::add_volume(world, name, solid),
                   {uniform(random, -half, half), uniform(random, -half, half),
                    uniform(random, -half, half)},
                   {0, 0, i % 3 == 0 ? uniform(random, 0, 3) : 0.0});
    }
  };
  fill(inner, 40, 5);
  fill(world.top, 70, 18);
  tests::place(world, world.top, inner, {4, -3, 2}, {0.4, 0.2, 0});
  finish(world);
  return world;
}

struct Walked {
  std::size_t steps = 0, kept = 0;
};

/// Steps, some limited, some turned aside, and some from points moved along or beside the ray,
/// compared with those of the generic navigator.
Walked walk(const tests::BoundWorld& bound, std::uint64_t seed, int rays, double turns) {
  const Geometry& geometry = bound.geometry;
  const auto right = std::make_unique<NavigationStack>(), got = std::make_unique<NavigationStack>();
  kernels::BoxesAhead kept[2]{};
  got->boxes_ahead = kept;
  std::mt19937_64 random(seed);
  Walked walked;
  for (int ray = 0; ray < rays; ++ray) {
    Vec3 p{uniform(random, -19, 19), uniform(random, -19, 19), uniform(random, -19, 19)};
    Vec3 v = tests::random_direction(random);
    generic::locate(geometry, *right, p, v);
    generic::locate(geometry, *got, p, v);
    for (int n = 0; n < 200 && right->depth >= 0; ++n) {
      const double limit = random() % 4 == 0 ? uniform(random, 0, 10) : unlimited;
      const int depth = got->depth;
      const kernels::BoxesAhead& boxes = kept[depth % 2];
      const bool known =
          boxes.search != nullptr && boxes.mother == got->levels[depth].touchable && n > 0;
      const Vec3 before{boxes.at[0], boxes.at[1], boxes.at[2]};
      const auto [length, same] = bound.step_both(*right, *got, p, v, limit);
      EXPECT_TRUE(same) << "ray " << ray << ", step " << n;
      if (!same) return walked;
      ++walked.steps;
      if (known && boxes.search != nullptr && before.x == boxes.at[0]) ++walked.kept;
      p += length * v;
      if (uniform(random, 0, 1) < turns) v = tests::random_direction(random);
      if (random() % 20 == 0 && right->depth >= 0) {
        // Elsewhere in the same world, without a word to the stack that keeps boxes.
        if (random() % 2 == 0) p += uniform(random, -5, 5) * v;
        if (random() % 2 == 0) p += uniform(random, -1, 1) * tests::random_direction(random);
        generic::locate(geometry, *right, p, v);
        if (right->depth < 0) break;
        generic::restore(geometry, *got, right->levels[right->depth].touchable);
      }
    }
  }
  return walked;
}

TEST(BoxesAhead, AreKeptAndChangeNoAnswer) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const tests::BoundWorld bound(halls(seed), Candidates::groups);
    const Walked straight = walk(bound, seed, 2000, 0.02);
    EXPECT_GT(10 * straight.kept, straight.steps) << "they are kept";
    const Walked scattered = walk(bound, seed + 10, 2000, 1);
    // But where a step of no length is followed by another one.
    EXPECT_LT(100 * scattered.kept, scattered.steps) << "of one direction";
    EXPECT_GT(scattered.steps, 4000U);
  }
}

}  // namespace
}  // namespace navjit
