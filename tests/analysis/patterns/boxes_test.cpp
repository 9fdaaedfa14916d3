// Candidates from cells and blocks of boxes: no daughter that is met is ever left out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "analysis/patterns/grid.hpp"
#include "analysis/plan.hpp"
#include "geometry/navigation/generic.hpp"
#include "geometry/solids/box_blocks.hpp"
#include "geometry/solids/extent.hpp"
#include "geometry/solids/list.hpp"
#include "navjit/vector.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

using tests::random_direction;
using tests::uniform;

/// A box turned about a random axis, in a scene from -`scene` to +`scene`.
struct Turned {
  Solid solid;
  Transformation at;
};

Transformation turned(std::mt19937_64& random, double scene) {
  double rotation[9];
  rotation_from_angles(uniform(random, 0.1, 3), uniform(random, 0.1, 3), uniform(random, 0.1, 3),
                       rotation);
  const auto somewhere = [&] { return uniform(random, -0.9 * scene, 0.9 * scene); };
  return make_transformation({somewhere(), somewhere(), somewhere()}, rotation);
}

/// A grid in the form that BlockGrid has.
struct Blocks {
  std::vector<unsigned> first{0};
  std::vector<kernels::BoxBlock> blocks;
  std::vector<std::array<unsigned, kernels::box_lanes>> daughters;
  kernels::BlockGrid<unsigned> grid;

  Blocks(const Grid& b, const std::vector<Extent>& boxes) {
    for (std::size_t cell = 0; cell < b.size(); ++cell) {
      for (auto m = b.first[cell]; m < b.first[cell + 1]; m += kernels::box_lanes) {
        kernels::BoxBlock block;
        std::array<unsigned, kernels::box_lanes> lanes{};
        for (unsigned i = 0; i < kernels::box_lanes; ++i) {
          const bool used = m + i < b.first[cell + 1];
          const Extent* e = used ? &boxes[b.members[m + i]] : nullptr;
          const double low[3] = {used ? e->min.x : INFINITY, used ? e->min.y : INFINITY,
                                 used ? e->min.z : INFINITY};
          const double high[3] = {used ? e->max.x : -INFINITY, used ? e->max.y : -INFINITY,
                                  used ? e->max.z : -INFINITY};
          for (int axis = 0; axis < 3; ++axis) {
            block.low[axis][i] = static_cast<float>(low[axis]);
            block.high[axis][i] = static_cast<float>(high[axis]);
          }
          if (used) lanes[i] = b.members[m + i];
        }
        blocks.push_back(block);
        daughters.push_back(lanes);
      }
      first.push_back(static_cast<unsigned>(blocks.size()));
    }
    for (int a = 0; a < 3; ++a) {
      grid.count[a] = b.count[a];
      grid.origin[a] = b.origin[a];
      grid.width[a] = b.width[a];
      grid.per_mm[a] = 1 / b.width[a];
    }
    grid.first = first.data();
    grid.blocks = blocks.data();
    grid.daughters = reinterpret_cast<const unsigned(*)[kernels::box_lanes]>(daughters.data());
  }
  Blocks(const Blocks&) = delete;
};

TEST(BoxBlocks, OfferEveryObliqueBoxThatAPointOrARayMeets) {
  std::mt19937_64 random(11);
  for (const double scale : {1e-3, 1.0, 1e5}) {
    const double half = 10 * scale;
    const Extent scene{{-half, -half, -half}, {half, half, half}};
    const double margin = 1e-9 * half;
    constexpr std::size_t count = 120;
    std::vector<Turned> turned_boxes;
    std::vector<PlacedBox> placed;
    std::vector<Extent> boxes;
    for (std::size_t k = 0; k < count; ++k) {
      turned_boxes.push_back(
          {make_box("box", scale * uniform(random, 0.1, 3), scale * uniform(random, 0.1, 3),
                    scale * uniform(random, 0.1, 3)),
           turned(random, half)});
      placed.push_back(placed_box(turned_boxes[k].solid, turned_boxes[k].at));
      EXPECT_TRUE(placed[k].oblique);
      boxes.push_back(inflated(placed[k].bounds, margin + 0x1p-21 * 2 * half));
    }
    const auto apart = [&](std::uint32_t k, const Extent& box) {
      const Turned& t = turned_boxes[k];
      return safety_to_in(t.solid.any(), to_local(t.at, 0.5 * (box.min + box.max))) >
             norm(0.5 * (box.max - box.min)) + 2 * margin;
    };
    const Grid grid = make_grid(scene, placed, margin, CellUse::blocks, apart);
    const Grid bounds_only = make_grid(scene, placed, margin, CellUse::blocks);
    EXPECT_LE(grid.members.size(), bounds_only.members.size());
    const Blocks blocks(grid, boxes);
    std::size_t offered = 0, met = 0;
    for (int i = 0; i < 4000; ++i) {
      Vec3 p{uniform(random, -half, half), uniform(random, -half, half),
             uniform(random, -half, half)};
      if (i % 7 == 0) p = boxes[random() % count].min;
      Vec3 d = random_direction(random);
      if (i % 5 == 0) d = {0, i % 2 == 0 ? 1.0 : -1.0, 0};
      const Direction v = kernels::make_direction(d.x, d.y, d.z);
      std::vector<char> at(count, 0), along(count, 0);
      kernels::visit_blocks_at(blocks.grid, p, [&](unsigned k) {
        at[k] = 1;
        return true;
      });
      double best = INFINITY;
      kernels::walk_blocks(
          blocks.grid, p, v,
          [&](unsigned k) {
            along[k] = 1;
            const Turned& t = turned_boxes[k];
            best = std::min(
                best, distance_to_in(t.solid.any(), to_local(t.at, p), to_local(t.at, v), 1e-11));
          },
          [&] { return best; });
      offered += static_cast<std::size_t>(std::count(along.begin(), along.end(), 1));
      double nearest = INFINITY;
      for (std::size_t k = 0; k < count; ++k) {
        const Turned& t = turned_boxes[k];
        const Vec3 q = to_local(t.at, p);
        EXPECT_TRUE(at[k] || inside(t.solid.any(), q, 1e-11) == Side::outside);
        nearest = std::min(nearest, distance_to_in(t.solid.any(), q, to_local(t.at, v), 1e-11));
      }
      EXPECT_EQ(best, nearest) << "ray " << i << " at scale " << scale;
      met += nearest < INFINITY ? 1 : 0;
    }
    EXPECT_GT(met, 1000U);
    EXPECT_LT(offered, std::size_t{4000} * count / 5) << "no filter at all";
  }
}

TEST(Plan, HollowDaughtersAreNotWhereTheirHolesAre) {
  // Rings around an axis, and rods on a circle: what is on the axis meets none of them.
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 100, 100, 100));
  const VolumeId ring = tests::add_volume(world, "ring", make_tube("ring", 80, 82, 1, 0, 7));
  const VolumeId rod = tests::add_volume(world, "rod", make_tube("rod", 0, 1, 90, 0, 7));
  for (int i = 0; i < 40; ++i) tests::place(world, world.top, ring, {0, 0, -90.0 + 4.5 * i});
  for (int i = 0; i < 150; ++i) {
    tests::place(world, world.top, rod, {90 * std::cos(0.04 * i), 90 * std::sin(0.04 * i), 0});
  }
  finish(world);
  const Geometry geometry(std::make_shared<const World>(std::move(world)));
  const ScenePlan plan = plan_scene(geometry, analyse_world(geometry), geometry.world().top);
  ASSERT_EQ(plan.candidates, Candidates::boxes);
  std::size_t empty = 0;
  for (std::size_t b = 0; b < plan.grid.size(); ++b) {
    empty += plan.grid.first[b] == plan.grid.first[b + 1] ? 1 : 0;
  }
  EXPECT_GT(empty, 0U);
}

TEST(Plan, FindsThousandsOfUnlikeDaughtersByBoxes) {
  std::mt19937_64 random(9);
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 100, 100, 100));
  const VolumeId box = tests::add_volume(world, "box", make_box("box", 1, 0.5, 0.7)),
                 tube = tests::add_volume(world, "tube", make_tube("tube", 0, 1, 0.5, 0, 7));
  for (int i = 0; i < 5000; ++i) {
    const auto at = [&] { return tests::uniform(random, -98, 98); };
    tests::place(world, world.top, i % 2 == 0 ? box : tube, {at(), at(), at()}, {at(), at(), at()});
  }
  finish(world);
  const Geometry geometry(std::make_shared<const World>(std::move(world)));
  const ScenePlan plan = plan_scene(geometry, analyse_world(geometry), 0);
  EXPECT_EQ(plan.candidates, Candidates::boxes);
  EXPECT_EQ(plan.boxes.size(), 5000U);
  EXPECT_LT(plan.mean_candidates, 20);
  EXPECT_FALSE(worth_compiling(geometry, plan)) << "too much text";
}

}  // namespace
}  // namespace navjit
