// Slabs within slabs: they are found, and nothing that a ray or a point meets is left out.
#include "analysis/patterns/layers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "analysis/plan.hpp"
#include "codegen/data/bind.hpp"
#include "codegen/data/parts.hpp"
#include "tests/analysis/patterns/arrangement.hpp"

namespace navjit {
namespace {

using tests::Arrangement;
using tests::pattern_tolerance;
using tests::uniform;

constexpr double half = 60;

/// Layers along z of rows of tiles, some of which are missing, with a plate behind each layer; the
/// plates may overlap with the tiles.
void add_calorimeter(Arrangement& a, std::mt19937_64& random, double overlap, bool turned) {
  for (int layer = 0; layer < 7; ++layer) {
    const double z = -48 + 14 * layer;
    for (int i = 0; i < 5; ++i) {
      for (int j = 0; j < 4; ++j) {
        if (random() % 6 == 0) continue;
        a.add(make_box("tile", 5, 6, 1), {-24 + 11.0 * i, -21 + 13.0 * j, z},
              {0, 0, turned ? 0.1 : 0.0});
      }
    }
    a.add(make_box("plate", 40, 40, 2), {0, 0, z + 3.5 - overlap});
  }
}

Arrangement calorimeter(std::uint64_t seed, double overlap, bool turned) {
  std::mt19937_64 random(seed);
  Arrangement a(make_box("mother", half, half, half));
  add_calorimeter(a, random, overlap, turned);
  a.finished(random);
  return a;
}

/// Straws in rows; each row lies on the gaps of the row below.
Arrangement straws(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Arrangement a(make_box("mother", half, half, half));
  for (int row = 0; row < 6; ++row) {
    for (int i = 0; i < 9; ++i) {
      a.add(make_tube("straw", 0, 5, 30, 0, 7),
            {-40 + 10.0 * i + (row % 2 == 0 ? 0.0 : 5.0), -20 + 8.7 * row, 0});
    }
  }
  a.finished(random);
  return a;
}

/// A row of boxes, and three turned boxes that no plane between them divides.
Arrangement with_a_group() {
  std::mt19937_64 random(3);
  Arrangement a(make_box("mother", half, half, half));
  for (int i = 0; i < 6; ++i) a.add(make_box("box", 2, 2, 2), {-20 + 6.0 * i, 0, -30});
  for (int i = 0; i < 3; ++i) {
    a.add(make_box("core", 3, 3, 3), {0, -3.0 + 4.0 * i, 20.0 + 4.0 * i}, {0.3, 0.2, 0.1});
  }
  a.finished(random);
  return a;
}

/// Blocks of rows. They are divided twice along the same axis: the blocks follow one another on it.
Arrangement blocks_of_rows() {
  std::mt19937_64 random(8);
  Arrangement a(make_box("mother", half, half, half));
  for (int block = 0; block < 6; ++block) {
    for (int row = 0; row < 3; ++row) {
      // No plane passes between the rows of all blocks, and none between the bricks of all rows.
      const double x = -50 + 20.0 * block + 4 * (row % 2), y = -22 + 11.0 * row + 3.7 * (block % 3);
      a.add(make_box("brick", 4, 4, 8), {x - 4.2, y, 0});
      a.add(make_box("brick", 4, 4, 8), {x + 4.2, y, 0});
    }
  }
  a.finished(random);
  return a;
}

WorldFacts forced_to_layers(const Geometry& geometry) {
  WorldFacts facts = analyse_world(geometry);
  facts.forced_candidates[0] = Candidates::layers;
  return facts;
}

/// Compares what the search offers with every daughter's own kernel.
void expect_nothing_left_out(const Arrangement& a, std::uint64_t seed) {
  const Geometry& geometry = *a.geometry;
  const ScenePlan plan = plan_scene(geometry, forced_to_layers(geometry), 0);
  ASSERT_EQ(plan.candidates, Candidates::layers);
  codegen::Arena arena;
  kernels::SearchLayers<codegen::Index> search{};
  codegen::make({geometry, plan, geometry.scene(0), arena}, search);
  std::mt19937_64 random(seed);
  std::size_t met = 0, offered = 0, held = 0;
  constexpr int rays = 4000;
  for (int i = 0; i < rays; ++i) {
    const auto [p, d] = tests::random_ray(random, a, half, i);
    const Direction v = kernels::make_direction(d.x, d.y, d.z);
    std::vector<char> along(a.daughters().size(), 0), at = along;
    const auto visit = [&](unsigned k) { along[k] = 1; };
    const auto reach = [] { return tests::infinite; };
    kernels::walk_layers(search.tree, search.tree.rows[0], kernels::LayerRay(p, v),
                         kernels::float_ray(p, v), 0, tests::infinite, visit, reach);
    const auto visit_at = [&](unsigned k) { at[k] = 1; };
    kernels::visit_layers_at(search.tree, search.tree.rows[0], p, visit_at);
    for (std::size_t k = 0; k < along.size(); ++k) {
      const Daughter& daughter = a.daughters()[k];
      offered += along[k] != 0 ? 1 : 0;
      if (tests::distance(daughter, p, v) < tests::infinite) {
        ++met;
        EXPECT_TRUE(along[k]) << "ray " << i << ", daughter " << k;
      }
      if (inside(daughter.solid, to_local(daughter.transformation, p), pattern_tolerance) !=
          Side::outside) {
        ++held;
        EXPECT_TRUE(at[k]) << "point " << i << ", daughter " << k;
      }
    }
  }
  EXPECT_GT(met, 200U);
  EXPECT_GT(held, 50U);
  EXPECT_LT(offered, rays * a.daughters().size() / 2) << "it is a search";
}

TEST(Layers, AreFoundLevelByLevel) {
  const Arrangement a = calorimeter(1, 0, false);
  const ScenePlan plan = plan_scene(*a.geometry, forced_to_layers(*a.geometry), 0);
  ASSERT_TRUE(plan.layers.found());
  EXPECT_EQ(describe_layers(plan.layers), "14 layers along z of 5 along x of 4 along y");
  EXPECT_EQ(plan.layers.groups.size(), 0U);
  EXPECT_NEAR(plan.layers.mean_group, 1, 1e-9);
  EXPECT_EQ(codegen::structure_of(*a.geometry, plan), "unrotated box, layers of boxes");
  // Unforced they are for data; what is compiled has a search of its own.
  const ScenePlan unforced = plan_scene(*a.geometry, analyse_world(*a.geometry), 0);
  EXPECT_TRUE(unforced.layers.found());
  EXPECT_NE(unforced.candidates, Candidates::layers);
}

TEST(Layers, NeedPlanesThatPassBetweenDaughters) {
  std::mt19937_64 random(2);
  Arrangement a(make_box("mother", half, half, half));
  for (int i = 0; i < 100; ++i) {
    a.add(make_box("box", 20, 20, 20),
          {uniform(random, -20, 20), uniform(random, -20, 20), uniform(random, -20, 20)});
  }
  a.finished(random);
  EXPECT_FALSE(plan_scene(*a.geometry, forced_to_layers(*a.geometry), 0).layers.found());
}

TEST(Layers, MayOverlapByLittle) {
  for (const double overlap : {0.0, 0.4}) {
    const Arrangement a = calorimeter(1, overlap, false);
    const ScenePlan plan = plan_scene(*a.geometry, forced_to_layers(*a.geometry), 0);
    ASSERT_TRUE(plan.layers.found()) << overlap;
    EXPECT_EQ(plan.layers.divisions[0].parts.size(), 14U) << overlap;
  }
  EXPECT_EQ(describe_layers(
                plan_scene(*straws(1).geometry, forced_to_layers(*straws(1).geometry), 0).layers),
            "6 layers along y of 9 along x");
}

TEST(Layers, LeaveNothingOutThatIsMet) {
  std::uint64_t seed = 10;
  for (const bool turned : {false, true}) {
    for (const double overlap : {0.0, 0.4}) {
      SCOPED_TRACE(overlap);
      expect_nothing_left_out(calorimeter(seed, overlap, turned), seed + 1);
      seed += 2;
    }
  }
  {
    SCOPED_TRACE("straws");
    expect_nothing_left_out(straws(4), 5);
  }
  const Arrangement grouped = with_a_group();
  const ScenePlan plan = plan_scene(*grouped.geometry, forced_to_layers(*grouped.geometry), 0);
  ASSERT_EQ(plan.layers.groups.size(), 1U);
  EXPECT_EQ(plan.layers.groups[0].size(), 3U);
  expect_nothing_left_out(grouped, 6);
}

/// A safety among all daughters, each no nearer than its box, and how many the search asks for it.
struct Safeties {
  double expected, given;
  std::size_t asked;
};

Safeties safeties(const Arrangement& a, const kernels::SearchLayers<codegen::Index>& search,
                  const Vec3& p, double start) {
  const kernels::BoxDistance from(p);
  const auto away = [&](unsigned k) {
    const Daughter& d = a.daughters()[k];
    return safety_to_in(d.solid, to_local(d.transformation, p));
  };
  Safeties result{start, start, 0};
  for (unsigned k = 0; k < a.daughters().size(); ++k) {
    result.expected = std::min(result.expected, std::max(from(search.boxes[k]), away(k)));
  }
  const auto ask = [&](unsigned k, double least) {
    ++result.asked;
    return std::min(least, std::max(from(search.boxes[k]), away(k)));
  };
  const kernels::LayerPoint point{p, (std::max(search.largest, 80.0) + start) * 0x1p-20};
  result.given =
      kernels::safety_among_layers(search.tree, search.tree.rows[0], point, {}, start, ask);
  return result;
}

void expect_the_same_safeties(const Arrangement& a, std::uint64_t seed, std::size_t most_asked) {
  const Geometry& geometry = *a.geometry;
  ASSERT_NE(geometry.scene(0).boxes, nullptr);
  const ScenePlan plan = plan_scene(geometry, forced_to_layers(geometry), 0);
  codegen::Arena arena;
  kernels::SearchLayers<codegen::Index> search{};
  codegen::make({geometry, plan, geometry.scene(0), arena}, search);
  ASSERT_NE(search.boxes, nullptr);
  std::mt19937_64 random(seed);
  std::size_t asked = 0;
  constexpr std::size_t points = 3000;
  for (std::size_t i = 0; i < points; ++i) {
    // Some beyond the mother.
    const Vec3 p{uniform(random, -80, 80), uniform(random, -80, 80), uniform(random, -80, 80)};
    const double start = i % 2 == 0 ? 60 : uniform(random, 0, 5);
    const Safeties s = safeties(a, search, p, start);
    ASSERT_EQ(s.given, s.expected) << "point " << i;
    asked += s.asked;
  }
  EXPECT_LT(asked, points * most_asked) << "it is a search";
}

TEST(Layers, TellTheSafetyByFewOfTheDaughters) {
  for (const bool turned : {false, true}) {
    SCOPED_TRACE(turned);
    expect_the_same_safeties(calorimeter(21, turned ? 0.4 : 0, turned), 22, 12);
  }
  expect_the_same_safeties(straws(23), 24, 8);
  expect_the_same_safeties(with_a_group(), 25, 6);
  const Arrangement blocks = blocks_of_rows();
  const ScenePlan plan = plan_scene(*blocks.geometry, forced_to_layers(*blocks.geometry), 0);
  ASSERT_EQ(describe_layers(plan.layers), "6 layers along x of 3 along y of 2 along x");
  expect_the_same_safeties(blocks, 26, 8);
}

}  // namespace
}  // namespace navjit
