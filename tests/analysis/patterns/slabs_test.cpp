#include "analysis/patterns/slabs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "geometry/solids/box_blocks.hpp"
#include "geometry/solids/list.hpp"
#include "tests/support/worlds.hpp"

// clang-format off
#include "geometry/kernels/slabs.h"
// clang-format on

namespace navjit {
namespace {

using tests::random_direction;
using tests::uniform;

constexpr double tolerance = 1e-9, margin = 1e-8;
constexpr double inf = std::numeric_limits<double>::infinity();

double& along(Vec3& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

/// Slabs in a cube of 20 mm: some touch, others leave gaps; in any order.
std::vector<Extent> random_slabs(std::mt19937_64& random, int axis, std::size_t count) {
  std::vector<Extent> boxes;
  double from = -10;
  const double pitch = 20.0 / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double gap = random() % 3 == 0 ? 0 : uniform(random, 0, 0.4 * pitch);
    Extent e{{uniform(random, -9, -1), uniform(random, -9, -1), uniform(random, -9, -1)},
             {uniform(random, 1, 9), uniform(random, 1, 9), uniform(random, 1, 9)}};
    along(e.min, axis) = from + gap;
    from += gap + uniform(random, 0.1, 0.6) * pitch;
    along(e.max, axis) = from;
    boxes.push_back(e);
  }
  std::shuffle(boxes.begin(), boxes.end(), random);
  return boxes;
}

struct OwnedSlabs {
  Slabs slabs;
  std::vector<std::uint32_t> position;
  kernels::SlabRow<std::uint32_t> row;
  explicit OwnedSlabs(Slabs from) : slabs(std::move(from)), position(slabs.members.size()) {
    for (std::uint32_t i = 0; i < position.size(); ++i) position[slabs.members[i]] = i;
    row = {static_cast<int>(slabs.members.size()),
           slabs.low.data(),
           slabs.high.data(),
           slabs.members.data(),
           position.data(),
           margin + tolerance / 2,
           slabs.origin,
           1 / slabs.width,
           static_cast<int>(slabs.ascending.size()),
           slabs.ascending.data(),
           slabs.descending.data()};
  }
  OwnedSlabs(const OwnedSlabs&) = delete;
};

/// The daughter's distance by its own kernel.
double distance(const Extent& e, const Vec3& p, const Direction& v) {
  const kernels::Box<double> box{(e.max.x - e.min.x) / 2, (e.max.y - e.min.y) / 2,
                                 (e.max.z - e.min.z) / 2};
  const Vec3 q{p.x - (e.min.x + e.max.x) / 2, p.y - (e.min.y + e.max.y) / 2,
               p.z - (e.min.z + e.max.z) / 2};
  return distance_to_in(box, q, v, tolerance);
}

bool holds(const Extent& e, const Vec3& p) {
  return p.x >= e.min.x && p.x <= e.max.x && p.y >= e.min.y && p.y <= e.max.y && p.z >= e.min.z &&
         p.z <= e.max.z;
}

TEST(Slabs, LeadToWhatTheRayMeetsFirst) {
  std::mt19937_64 random(3);
  const Extent scene{{-10, -10, -10}, {10, 10, 10}};
  std::size_t asked = 0, all = 0, met = 0;
  for (int round = 0; round < 60; ++round) {
    const int axis = round % 3;
    const std::size_t count = 2 + random() % 60;
    const std::vector<Extent> boxes = random_slabs(random, axis, count);
    auto found = find_slabs(scene, boxes, tolerance, margin);
    ASSERT_TRUE(found);
    const OwnedSlabs owned(std::move(*found));
    for (int i = 0; i < 500; ++i) {
      Vec3 p{uniform(random, -11, 11), uniform(random, -11, 11), uniform(random, -11, 11)};
      Vec3 d = random_direction(random);
      if (i % 5 == 0) along(d = {0, 0, 0}, static_cast<int>(random() % 3)) = i % 2 == 0 ? 1 : -1;
      unsigned last_left = 0;
      if (i % 7 == 0) {  // on faces and edges, as after leaving that one
        last_left = static_cast<unsigned>(random() % count);
        p = i % 2 == 0 ? boxes[last_left].min : boxes[last_left].max;
      }
      if (std::any_of(boxes.begin(), boxes.end(), [&](const Extent& e) {
            return holds(e, p) && distance(e, p, kernels::make_direction(d.x, d.y, d.z)) == inf;
          })) {
        continue;  // in a slab, and not about to enter it: then the track is not in the mother
      }
      const Direction v = kernels::make_direction(d.x, d.y, d.z);
      double nearest = inf;
      all += count;
      for (const Extent& e : boxes) nearest = std::min(nearest, distance(e, p, v));
      double hit = inf;
      const double coordinate[3] = {p.x, p.y, p.z}, rate[3] = {v.x, v.y, v.z};
      const double inverse[3] = {v.inverse_x, v.inverse_y, v.inverse_z};
      const int a = owned.slabs.axis;
      // Whatever is said to have been left last changes nothing.
      const unsigned guesses[] = {~0U, static_cast<unsigned>(random() % count), last_left};
      for (const unsigned left : guesses) {
        hit = inf;
        kernels::walk_slabs(owned.row, coordinate[a], rate[a], inverse[a], 40, left,
                            [&](unsigned k) {
                              asked += left == ~0U ? 1 : 0;
                              const double t = distance(boxes[k], p, v);
                              hit = std::min(hit, t);
                              return t < inf;
                            });
        EXPECT_EQ(hit, nearest) << "round " << round << ", ray " << i << ", left " << left;
      }
      met += hit < inf ? 1 : 0;
    }
  }
  EXPECT_GT(met, 3000U);
  EXPECT_LT(3 * asked, all) << "no filter at all";
}

TEST(Slabs, OfferAllThatHoldAPoint) {
  std::mt19937_64 random(4);
  const Extent scene{{-10, -10, -10}, {10, 10, 10}};
  for (int round = 0; round < 30; ++round) {
    const std::vector<Extent> boxes = random_slabs(random, round % 3, 2 + random() % 60);
    auto found = find_slabs(scene, boxes, tolerance, margin);
    ASSERT_TRUE(found);
    const OwnedSlabs owned(std::move(*found));
    for (int i = 0; i < 500; ++i) {
      Vec3 p{uniform(random, -11, 11), uniform(random, -11, 11), uniform(random, -11, 11)};
      if (i % 3 == 0) p = boxes[random() % boxes.size()].max;
      const double coordinate[3] = {p.x, p.y, p.z};
      std::vector<char> offered(boxes.size(), 0);
      kernels::visit_slabs_at(owned.row, coordinate[owned.slabs.axis],
                              [&](unsigned k) { offered[k] = 1; });
      for (std::size_t k = 0; k < boxes.size(); ++k) {
        EXPECT_TRUE(offered[k] || !holds(boxes[k], p)) << "slab " << k;
      }
    }
  }
}

TEST(Slabs, StopAtTheReach) {
  std::vector<Extent> boxes;
  for (int k = 0; k < 100; ++k) boxes.push_back({{-1, -1, k + 0.1}, {1, 1, k + 0.9}});
  const OwnedSlabs owned(*find_slabs({{-1, -1, 0}, {1, 1, 100}}, boxes, tolerance, margin));
  int offered = 0;
  kernels::walk_slabs(owned.row, 50.0, 1.0, 1.0, 3.0, ~0U, [&](unsigned) {
    ++offered;
    return false;
  });
  EXPECT_GE(offered, 3);
  EXPECT_LE(offered, 4);
}

TEST(Slabs, AreNotSeenWhereDaughtersOverlapOrAreTooThin) {
  const Extent scene{{-10, -10, -10}, {10, 10, 10}};
  const Extent left{{-5, -5, -5}, {0, 5, 5}};
  const auto seen = [&](const Extent& other) {
    const Extent both[] = {left, other};
    return find_slabs(scene, both, tolerance, margin).has_value();
  };
  EXPECT_TRUE(seen({{0, -5, -5}, {5, 5, 5}}));
  EXPECT_FALSE(seen({{-1, -4, -4}, {5, 4, 4}}));
  EXPECT_FALSE(seen({{1, -5, -5}, {1 + 4e-9, 5, 5}}));
  EXPECT_FALSE(find_slabs(scene, std::span(&left, 1), tolerance, margin).has_value());
}

}  // namespace
}  // namespace navjit
