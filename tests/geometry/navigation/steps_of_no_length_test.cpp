#include "geometry/navigation/steps_of_no_length.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <vector>

#include "geometry/navigation/generic.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// Relocates as the generic navigator does, and then enters the first daughter, right or wrong.
void enter_wrongly(NavigationStack* stack, const kernels::Context* context, const void*, double x,
                   double y, double z, int blocked) {
  const auto& geometry = *static_cast<const Geometry*>(context->geometry);
  const double* const u = stack->ray.given;
  generic::relocate(geometry, *stack, {x, y, z}, {u[0], u[1], u[2]}, blocked);
  if (stack->depth < 0) return;
  const Scene& scene = geometry.scene(stack->levels[stack->depth].volume);
  if (scene.daughters.empty()) return;
  const Daughter& d = scene.daughters[0];
  push(*stack, d.transformation, d.volume, 0, d.offset);
}

struct Made {
  std::uint64_t left = 0, returned = 0, unknown = 0;
};

/// Photons are reflected at every boundary, half of them exactly backwards, and each of their steps
/// of length zero is made in both ways.
Made reflect(const Geometry& geometry, const kernels::DispatchEntry& entry, std::uint64_t seed,
             int photons) {
  const std::vector<const kernels::DispatchEntry*> table(geometry.size(), &entry);
  const kernels::Context context{table.data(), &geometry, leave_at_once, return_at_once};
  const auto right = std::make_unique<NavigationStack>(), got = std::make_unique<NavigationStack>();
  right->depth = got->depth = -1;
  std::mt19937_64 random(seed);
  const double half = geometry.world().volumes[geometry.world().top].solid.extent.max.x;
  Made made;
  for (int photon = 0; photon < photons; ++photon) {
    Vec3 p{uniform(random, -half, half), uniform(random, -half, half),
           uniform(random, -half, half)};
    Vec3 v = tests::random_direction(random);
    generic::locate(geometry, *right, p, v);
    for (int n = 0; n < 60 && right->depth >= 0; ++n) {
      copy(*right, *got);
      // The level above tells what was left last; copies have none.
      if (right->depth + 1 < kernels::stack_levels) {
        got->levels[right->depth + 1].daughter = right->levels[right->depth + 1].daughter;
      }
      kernels::set_ray(*got, v.x, v.y, v.z);
      const int depth = got->depth;
      const double length = generic::step(geometry, *right, p, v, unlimited);
      if (length == 0) {
        const bool out =
            right->depth < depth || right->levels[depth].touchable != got->levels[depth].touchable;
        if (out) {
          leave_at_once(got.get(), &context, p.x, p.y, p.z);
          ++made.left;
        } else if (return_at_once(got.get(), &context, p.x, p.y, p.z) >= 0) {
          ++made.returned;
        } else {
          ++made.unknown;
          continue;
        }
        EXPECT_TRUE(identical(*right, *got)) << "photon " << photon << ", step " << n;
        EXPECT_EQ(got->boundary, 1);
      } else {
        EXPECT_LT(return_at_once(got.get(), &context, p.x, p.y, p.z), 0) << "it has a length";
      }
      p += length * v;
      v = random() % 2 == 0 ? -1.0 * v : tests::random_direction(random);
    }
  }
  return made;
}

TEST(StepsOfNoLength, AreThoseOfTheGenericNavigator) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Geometry geometry(std::make_shared<const World>(tests::random_world(seed, 3)));
    const Made made = reflect(geometry, generic::dispatch_entry, seed, 2000);
    EXPECT_GT(made.left, 500U);
    EXPECT_GT(made.returned, 500U);
    EXPECT_LT(20 * made.unknown, made.returned);
  }
  const Geometry mixed(std::make_shared<const World>(tests::mixed_world()));
  const Made made = reflect(mixed, generic::dispatch_entry, 4, 1000);
  EXPECT_GT(made.left, 500U);
  EXPECT_GT(made.returned, 500U);
  EXPECT_LT(20 * made.unknown, made.returned);
}

/// Boxes over one another, and out of the world.
TEST(StepsOfNoLength, AreThoseOfTheGenericNavigatorWhereVolumesOverlap) {
  for (const std::uint64_t seed : {5, 6, 7, 8}) {
    std::mt19937_64 random(seed);
    World world;
    world.top = tests::add_volume(world, "world", make_box("world", 20, 20, 20));
    const VolumeId inner = tests::add_volume(world, "inner", make_box("inner", 3, 2, 2));
    for (int i = 0; i < 12; ++i) {
      const std::string name = "v" + std::to_string(i);
      const VolumeId v = tests::add_volume(world, name, make_box(name, 4, 5, 1.0 + i));
      tests::place(world, v, inner, {2, 1, 0});
      // Some of them on a lattice, so that faces coincide.
      const double x =
          i % 2 == 0 ? 4.0 * static_cast<double>(random() % 9) - 16 : uniform(random, -18, 18);
      tests::place(world, world.top, v, {x, 2.0 * i - 12, uniform(random, -18, 18)},
                   {0, 0, i % 3 == 0 ? uniform(random, 0, 3) : 0.0});
    }
    finish(world);
    const Geometry geometry(std::make_shared<const World>(std::move(world)));
    const Made made = reflect(geometry, generic::dispatch_entry, seed, 600);
    EXPECT_GT(made.left + made.returned, 500U);
  }
}

/// What the table says is asked of the volumes' own frames, and where they deny it the generic
/// navigator decides.
TEST(StepsOfNoLength, BelieveNoRelocationThatFramesDeny) {
  for (const std::uint64_t seed : {1, 2}) {
    const Geometry geometry(std::make_shared<const World>(tests::random_world(seed, 3)));
    const kernels::DispatchEntry wrong{generic::dispatch_entry.step, enter_wrongly,
                                       generic::dispatch_entry.safety, nullptr};
    const Made made = reflect(geometry, wrong, seed, 1000);
    EXPECT_GT(made.left, 300U);
    EXPECT_GT(made.returned, 300U);
  }
}

}  // namespace
}  // namespace navjit
