// Safety among daughters by their boxes: its value, and which daughters it asks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "codegen/data/parts.hpp"
#include "geometry/model/random.hpp"
#include "geometry/solids/extent.hpp"

namespace navjit {
namespace {

Vec3 random_point(std::mt19937_64& random, double reach) {
  const double x = uniform(random, -reach, reach), y = uniform(random, -reach, reach);
  return {x, y, uniform(random, -reach, reach)};
}

double distance(const Extent& box, const Vec3& p) {
  const double x = std::max({box.min.x - p.x, p.x - box.max.x, 0.0});
  const double y = std::max({box.min.y - p.y, p.y - box.max.y, 0.0});
  const double z = std::max({box.min.z - p.z, p.z - box.max.z, 0.0});
  return std::hypot(x, y, z);
}

struct Case {
  std::vector<Extent> boxes;
  codegen::Arena arena;
  kernels::NearBoxes near{};

  explicit Case(std::size_t count) {
    std::mt19937_64 random(count);
    for (std::size_t k = 0; k < count; ++k) {
      const Vec3 centre = random_point(random, 1000);
      const double half = uniform(random, 1, 50);
      boxes.push_back(inflated({centre, centre}, half));
    }
    near = codegen::make_near_boxes(boxes, arena);
  }
};

TEST(NearBoxes, GiveTheSmallestDistanceWhereverThePointIs) {
  for (const std::size_t count : {1, 7, 8, 9, 64, 65, 128, 1000}) {
    Case c(count);
    std::mt19937_64 random(7);
    for (int n = 0; n < 2000; ++n) {
      const Vec3 p = random_point(random, 2000);
      const double start = uniform(random, 0, 1) < 0.5 ? 1e4 : uniform(random, 0, 500);
      double expected = start;
      for (const Extent& box : c.boxes) expected = std::min(expected, distance(box, p));
      const double given = kernels::safety_near_boxes(
          c.near, p, start, [&](unsigned k) { return distance(c.boxes[k], p); });
      // Boxes are in single precision.
      EXPECT_NEAR(given, expected, 1e-3) << count;
      EXPECT_LE(given, expected) << count;
    }
  }
}

TEST(NearBoxes, FarAwayNobodyIsAsked) {
  Case c(128);
  kernels::safety_near_boxes(c.near, {5000, 0, 0}, 100.0, [](unsigned k) {
    ADD_FAILURE() << k;
    return 0.0;
  });
}

TEST(NearBoxes, FewAreAskedWhereManyAreFarther) {
  Case c(1000);
  std::mt19937_64 random(3);
  std::size_t asked = 0;
  for (int n = 0; n < 1000; ++n) {
    const Vec3 p = random_point(random, 1000);
    kernels::safety_near_boxes(c.near, p, 1e4, [&](unsigned k) {
      ++asked;
      return distance(c.boxes[k], p);
    });
  }
  EXPECT_LT(asked, 30 * 1000);
  EXPECT_GE(asked, 1000);
}

}  // namespace
}  // namespace navjit
