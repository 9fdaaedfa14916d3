// Rays that touch round faces, nearly along them, in frames that are turned by the rounded value of
// pi: no ray gets stuck.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "geometry/navigation/generic.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();
constexpr double turn = 2 * std::numbers::pi;

/// A round body of radius 38 mm with a body of 37 mm in it, along z and turned upside down.
struct Bodies {
  Solid outer, inner;
};
std::vector<Bodies> round_bodies() {
  const std::vector<ZPlane> outer{{0, 0, 38}, {14, 0, 38}, {22, 0, 27}, {114, 0, 27}};
  const std::vector<ZPlane> inner{{1, 0, 37}, {13.5, 0, 37}, {21.5, 0, 26}, {113, 0, 26}};
  return {{make_polycone("outer", outer, 0, turn), make_polycone("inner", inner, 0, turn)},
          {make_tube("outer", 0, 38, 114, 0, turn), make_tube("inner", 0, 37, 113, 0, turn)},
          {make_cone("outer", 0, 38, 0, 38, 114, 0, turn),
           make_cone("inner", 0, 37, 0, 37, 113, 0, turn)},
          {make_eltube("outer", 38, 38, 114), make_eltube("inner", 37, 37, 113)}};
}

/// Whether the ray leaves the world; if not it is stuck.
bool goes_on(const Geometry& geometry, NavigationStack& stack, const Vec3& start, const Vec3& v) {
  Vec3 p = start;
  double path = 0;
  generic::locate(geometry, stack, p, v);
  for (int n = 0; stack.depth >= 0; ++n) {
    if (n == 200) return false;
    path += generic::step(geometry, stack, p, v, unlimited);
    p = start + path * v;
  }
  return true;
}

TEST(Tangents, NearlyAlongRoundFacesDoNotStopRays) {
  for (const Bodies& bodies : round_bodies()) {
    World world;
    world.top = tests::add_volume(world, "world", make_box("world", 1000, 1000, 1000));
    const VolumeId outer = tests::add_volume(world, "outer", bodies.outer);
    const VolumeId inner = tests::add_volume(world, "inner", bodies.inner);
    tests::place(world, outer, inner, {0, 0, 0});
    const double y = -554.24, z = -760;
    tests::place(world, world.top, outer, {0, y, z}, {3.14159265359, 0, 0});
    finish(world);
    const Geometry geometry(std::make_shared<const World>(std::move(world)));
    const auto stack = std::make_unique<NavigationStack>();
    stack->depth = -1;
    // The one that was stuck, and others like it.
    EXPECT_TRUE(goes_on(geometry, *stack, {-37, y - 2.3e-13, -761}, {0, 1.72e-5, -1}));
    std::mt19937_64 random(3);
    for (int ray = 0; ray < 20000; ++ray) {
      const double r = random() % 2 == 0 ? 37 : 38,
                   phi = turn * static_cast<double>(random() % 8) / 8;
      const double slope = std::exp(uniform(random, std::log(1e-9), std::log(1e-2)));
      const double off = 1e-12 * uniform(random, -1, 1);
      const double c = std::cos(phi), s = std::sin(phi), along = uniform(random, -20, 20);
      const Vec3 touch{r * c, y + r * s + off, z - 5};
      Vec3 v{-slope * s, slope * c, random() % 2 == 0 ? -1.0 : 1.0};
      v = (1 / norm(v)) * v;
      EXPECT_TRUE(goes_on(geometry, *stack, touch - along * v, v))
          << kind_name(bodies.outer.any().kind) << ", ray " << ray;
    }
  }
}

}  // namespace
}  // namespace navjit
