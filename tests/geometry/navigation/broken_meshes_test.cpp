// Worlds with solids whose facets do not close, and with outlines that cross themselves: no ray is
// stuck or lost.
#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "geometry/navigation/generic.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

using tests::Mesh;
using tests::uniform;

/// One solid with each defect, turned, with a small box inside.
World broken_world() {
  std::vector<Solid> solids;
  const auto add = [&](const Mesh& mesh) { solids.push_back(make_tessellated("mesh", mesh)); };
  for (const Mesh& whole : {tests::ball(2), tests::block()}) {
    Mesh flipped = whole, doubled = whole, open = whole, bent = whole, cut = whole;
    for (std::size_t i = 0; i < whole.size(); i += 5) tests::flip(flipped[i]);
    doubled.insert(doubled.end(), whole.begin(), whole.begin() + 3);
    open.erase(open.begin() + 1);
    bent[2][0] = 0.8 * bent[2][0];
    const FacetCorners f = cut[0];
    const Vec3 middle = 0.5 * (f[0] + f[1]);
    cut[0] = {f[0], middle, f[2]};
    cut.push_back({middle, f[1], f[2]});
    for (const Mesh& mesh : {flipped, doubled, open, bent, cut}) add(mesh);
  }
  std::vector<PlanarPoint> outline = tests::comb();
  outline[1] = {-7 + 0.01, -2};
  const std::vector<ExtrudedSection> sections{{-3, 0, 0, 1}, {3, 1, 0, 0.8}};
  solids.push_back(make_extruded("comb", outline, sections));

  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 20.0 * 12, 30, 30));
  const VolumeId core = tests::add_volume(world, "core", make_box("core", 0.5, 0.4, 0.3));
  for (std::size_t i = 0; i < solids.size(); ++i) {
    const VolumeId volume = tests::add_volume(world, "solid" + std::to_string(i), solids[i]);
    if (i + 1 < solids.size()) tests::place(world, volume, core, {1, 0, 0}, {0.3, 0.2, 0.1});
    tests::place(world, world.top, volume, {-210.0 + 40 * static_cast<double>(i), 0, 0},
                 {0.1 * static_cast<double>(i), 0.3, 0});
  }
  finish(world);
  return world;
}

TEST(BrokenMeshes, NoRayIsStuckOrLost) {
  const Geometry geometry(std::make_shared<const World>(broken_world()));
  std::mt19937_64 random(17);
  std::size_t entered = 0;
  for (int ray = 0; ray < 4000; ++ray) {
    Vec3 point{uniform(random, -230, 230), uniform(random, -29, 29), uniform(random, -29, 29)};
    Vec3 v = tests::random_direction(random);
    const auto stack = std::make_unique<NavigationStack>();
    generic::locate(geometry, *stack, point, v);
    int steps = 0, in_place = 0;
    while (stack->depth >= 0) {
      ASSERT_LT(++steps, 2000) << "ray " << ray << " goes on for ever";
      entered += stack->depth > 0 ? 1 : 0;
      // Every fourth ray scatters.
      const double limit = ray % 4 == 0 ? 5 : std::numeric_limits<double>::infinity();
      const double length = generic::step(geometry, *stack, point, v, limit);
      ASSERT_LT(length, 600) << "ray " << ray << " is lost";
      in_place = length > 0 ? 0 : in_place + 1;
      ASSERT_LT(in_place, 20) << "ray " << ray << " is stuck";
      point += length * v;
      if (ray % 4 == 0 && length == limit) {
        v = tests::random_direction(random);
        generic::locate(geometry, *stack, point, v);
      }
    }
    const auto& world = geometry.world();
    EXPECT_EQ(inside(world.volumes[world.top].solid.any(), point, 1e-9), Side::surface)
        << "ray " << ray << " ends within the world";
  }
  EXPECT_GT(entered, 1000U);
}

}  // namespace
}  // namespace navjit
