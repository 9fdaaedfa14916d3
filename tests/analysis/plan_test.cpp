#include "analysis/plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "analysis/patterns/grid.hpp"
#include "analysis/patterns/pattern.hpp"
#include "geometry/solids/box_blocks.hpp"
#include "geometry/solids/list.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

using tests::random_direction;
using tests::uniform;

std::vector<Extent> random_boxes(std::mt19937_64& random, std::size_t count) {
  std::vector<Extent> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 c{uniform(random, -9, 9), uniform(random, -9, 9), uniform(random, -9, 9)};
    const Vec3 h{uniform(random, 0, 1), uniform(random, 0, 1), uniform(random, 0, 1)};
    boxes.push_back({c - h, c + h});
  }
  return boxes;
}

std::vector<PlacedBox> placed(const std::vector<Extent>& boxes) {
  std::vector<PlacedBox> result;
  for (const Extent& box : boxes) result.push_back({box});
  return result;
}

struct OwnedGrid {
  std::vector<std::uint32_t> members;
  kernels::CellGrid<std::uint32_t> grid;
  explicit OwnedGrid(const Grid& b) : members(b.members) {
    for (int a = 0; a < 3; ++a) {
      grid.count[a] = b.count[a];
      grid.origin[a] = b.origin[a];
      grid.width[a] = b.width[a];
      grid.per_mm[a] = 1 / b.width[a];
    }
    grid.first = b.first.data();
    grid.members = members.data();
  }
  OwnedGrid(const OwnedGrid&) = delete;
};

TEST(Grid, OffersEveryBoxThatAPointOrARayMeets) {
  std::mt19937_64 random(1);
  const Extent scene{{-10, -10, -10}, {10, 10, 10}};
  for (const std::size_t count : {5, 40, 300}) {
    const std::vector<Extent> boxes = random_boxes(random, count);
    const Grid grid = make_grid(scene, placed(boxes), 1e-8);
    const OwnedGrid owned(grid);
    std::size_t offered = 0, rays = 0;
    for (int i = 0; i < 3000; ++i) {
      Vec3 p{uniform(random, -10, 10), uniform(random, -10, 10), uniform(random, -10, 10)};
      Vec3 d = random_direction(random);
      if (i % 5 == 0) d = {i % 2 == 0 ? 1.0 : -1.0, 0, 0};
      if (i % 7 == 0) p = boxes[random() % count].min;  // on faces and edges
      const Direction v = kernels::make_direction(d.x, d.y, d.z);
      std::vector<char> at(count, 0), along(count, 0);
      kernels::visit_cell_at(owned.grid, p, [&](unsigned k) {
        at[k] = 1;
        return true;
      });
      kernels::walk_cells(
          owned.grid, p, v, [&](unsigned k) { along[k] = 1; }, [] { return 40.0; });
      offered += static_cast<std::size_t>(std::count(along.begin(), along.end(), 1));
      ++rays;
      for (std::size_t k = 0; k < count; ++k) {
        const Extent& e = boxes[k];
        const bool in = p.x >= e.min.x && p.x <= e.max.x && p.y >= e.min.y && p.y <= e.max.y &&
                        p.z >= e.min.z && p.z <= e.max.z;
        EXPECT_TRUE(!in || at[k]);
        const kernels::Box<double> box{(e.max.x - e.min.x) / 2, (e.max.y - e.min.y) / 2,
                                       (e.max.z - e.min.z) / 2};
        const Vec3 q = p - 0.5 * (e.min + e.max);
        EXPECT_TRUE(along[k] || (!in && distance_to_in(box, q, v, 1e-11) >= 40));
      }
    }
    EXPECT_TRUE(count < 40 || offered < rays * count / 2) << "no filter at all";
  }
}

TEST(Grid, StopsAtTheReach) {
  // A hundred slabs: a short way meets few.
  std::vector<Extent> plates;
  for (int k = 0; k < 100; ++k) plates.push_back({{-1, -1, k + 0.1}, {1, 1, k + 0.9}});
  const Grid grid = make_grid({{-1, -1, 0}, {1, 1, 100}}, placed(plates), 1e-8);
  const OwnedGrid owned(grid);
  std::size_t offered = 0;
  kernels::walk_cells(
      owned.grid, {0, 0, 50.5}, kernels::make_direction(0.0, 0.0, 1.0),
      [&](unsigned) { ++offered; }, [] { return 1.0; });
  EXPECT_GE(offered, 1U);
  EXPECT_LE(offered, 6U);
}

TEST(Pattern, IsNamed) {
  std::vector<Extent> boxes;
  EXPECT_EQ(pattern_of(boxes).words, "leaf");
  EXPECT_EQ(pattern_of(boxes).arrangement, Arrangement::leaf);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 4; ++j)
      boxes.push_back({{i * 2.0, j * 3.0, 0}, {i * 2.0 + 1, j * 3.0 + 1, 1}});
  }
  EXPECT_EQ(pattern_of(boxes).words, "grid 3 x 4 x 1");
  EXPECT_EQ(pattern_of(boxes).arrangement, Arrangement::grid);
  const std::span all(boxes);
  EXPECT_EQ(pattern_of(all.first(4)).words, "4 slabs along y");
  EXPECT_EQ(pattern_of(all.first(4)).arrangement, Arrangement::slabs);
  EXPECT_EQ(pattern_of(all.first(1)).arrangement, Arrangement::single);
  EXPECT_EQ(pattern_of(all.first(5)).arrangement, Arrangement::other);
  const std::vector<Extent> about_one_point{{{-1, -1, -1}, {1, 1, 1}}, {{-2, -2, -2}, {2, 2, 2}}};
  EXPECT_EQ(pattern_of(about_one_point).arrangement, Arrangement::nest);
}

TEST(Plan, OfManyDaughtersIsKeptForEachQuestion) {
  std::mt19937_64 random(3);
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 10, 10, 10));
  for (int i = 0; i < 60; ++i) {
    const VolumeId box = tests::add_volume(world, "b", make_box("b", 0.1, 0.1, 0.1 + 1e-3 * i));
    tests::place(world, world.top, box,
                 {uniform(random, -9, 9), uniform(random, -9, 9), uniform(random, -9, 9)});
  }
  finish(world);
  const VolumeId top = world.top;
  const Geometry geometry(std::make_shared<const World>(std::move(world)));
  WorldFacts facts = analyse_world(geometry);
  const auto kept = [&](std::optional<Candidates> forced, bool along_faces) {
    return facts.known_plans->find({top, forced, along_faces, facts.with_safety}) != nullptr;
  };
  EXPECT_FALSE(kept({}, false));
  const ScenePlan first = plan_scene(geometry, facts, top);
  EXPECT_TRUE(kept({}, false));
  EXPECT_EQ(describe(geometry, plan_scene(geometry, facts, top)), describe(geometry, first));
  EXPECT_TRUE(first.bail_out_rare);
  facts.along_faces.insert(top);
  EXPECT_FALSE(kept({}, true));
  EXPECT_FALSE(plan_scene(geometry, facts, top).bail_out_rare);
  facts.forced_candidates[top] = Candidates::tree;
  EXPECT_EQ(plan_scene(geometry, facts, top).candidates, Candidates::tree);
  facts.forced_candidates.clear();
  facts.along_faces.clear();
  EXPECT_EQ(plan_scene(geometry, facts, top).candidates, first.candidates);
  // Leaves and small scenes are made anew.
  plan_scene(geometry, facts, top + 1);
  EXPECT_EQ(facts.known_plans->find({top + 1, {}, false, facts.with_safety}), nullptr);
}

TEST(Plan, SeesStacksAndGrids) {
  const Geometry geometry(std::make_shared<const World>(tests::mixed_world()));
  const WorldFacts facts = analyse_world(geometry);
  const auto plan = [&](const char* name) {
    for (VolumeId v = 0; v < geometry.size(); ++v) {
      if (geometry.world().volumes[v].name == name) return plan_scene(geometry, facts, v);
    }
    throw std::runtime_error(name);
  };
  const ScenePlan stack = plan("stack");
  EXPECT_EQ(stack.pattern, "20 slabs along z");
  EXPECT_EQ(stack.candidates, Candidates::slabs);
  EXPECT_EQ(stack.slabs.axis, 2);
  EXPECT_EQ(plan("plate").candidates, Candidates::grid);
  EXPECT_TRUE(stack.neighbour_lists);
  EXPECT_EQ(plan("plate").pattern, "grid 4 x 4 x 1");
  EXPECT_EQ(plan("tile").candidates, Candidates::none);
  EXPECT_TRUE(plan("stack").frame.never_rotated);
  EXPECT_FALSE(plan("turned").frame.never_rotated);
  EXPECT_NE(describe(geometry, stack).find("20 slabs along z"), std::string::npos);
}

/// Most rays pass beside small plates, and walking past one after the other is for nothing.
TEST(Plan, WalksSlabsThatFillTheirMotherAndScansOthers) {
  for (const auto& [plates, half, expected] : {std::tuple(12, 40.0, Candidates::slabs),
                                               {12, 30.0, Candidates::slabs},
                                               {12, 20.0, Candidates::scan},
                                               {3, 20.0, Candidates::lanes},
                                               {70, 20.0, Candidates::slabs}}) {
    World world;
    world.top = tests::add_volume(world, "world", make_box("world", 40, 40, 80));
    const VolumeId plate = tests::add_volume(world, "plate", make_box("plate", half, half, 0.5));
    for (int i = 0; i < plates; ++i) tests::place(world, world.top, plate, {0, 0, 2.0 * i - 75});
    finish(world);
    const Geometry geometry(std::make_shared<const World>(std::move(world)));
    const ScenePlan plan = plan_scene(geometry, analyse_world(geometry), geometry.world().top);
    EXPECT_EQ(plan.candidates, expected) << plates << " plates of " << half;
    // What a run may measure to be faster.
    EXPECT_EQ(plan.slabs.members.empty(), plates <= 4);
  }
}

}  // namespace
}  // namespace navjit
