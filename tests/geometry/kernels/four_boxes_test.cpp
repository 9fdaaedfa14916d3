// Four boxes asked at once answer as one after the other.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>
#include <vector>

#include "geometry/solids/list.hpp"
#include "tests/support/worlds.hpp"

// clang-format off
#include "geometry/kernels/four_boxes.h"
// clang-format on

namespace navjit::test {
namespace {

using namespace kernels;  // NOLINT: the kernels are the subject
using navjit::tests::random_direction;
using navjit::tests::uniform;
using V = kernels::Vec3<double>;
using D = kernels::Direction<double>;

constexpr double tolerance = 1e-9;

struct PlacedBox {
  V at;
  kernels::Box<double> box;
};

/// Boxes on a coarse lattice, so that faces coincide; some overlap.
std::vector<PlacedBox> random_boxes(std::mt19937_64& random, std::size_t count) {
  const auto coarse = [&](double lo, double hi) { return std::round(uniform(random, lo, hi)); };
  std::vector<PlacedBox> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    boxes.push_back({{coarse(-4, 4), coarse(-4, 4), coarse(-4, 4)},
                     {coarse(0.6, 3), coarse(0.6, 3), coarse(0.6, 3)}});
  }
  return boxes;
}

void fill(FourBoxes (&fours)[2], const std::vector<PlacedBox>& boxes) {
  for (std::size_t i = 0; i < 8; ++i) {
    FourBoxes& f = fours[i / 4];
    const std::size_t lane = i % 4;
    const bool used = i < boxes.size();
    f.x[lane] = used ? boxes[i].at.x : 0;
    f.y[lane] = used ? boxes[i].at.y : 0;
    f.z[lane] = used ? boxes[i].at.z : 0;
    f.hx[lane] = used ? boxes[i].box.hx : -INFINITY;
    f.hy[lane] = used ? boxes[i].box.hy : -INFINITY;
    f.hz[lane] = used ? boxes[i].box.hz : -INFINITY;
  }
}

/// A point anywhere, on faces and edges, or a little beside them.
V random_point(std::mt19937_64& random) {
  double p[3];
  for (double& x : p) {
    x = uniform(random, -8, 8);
    if (random() % 2 == 0) x = std::round(x);
    if (random() % 4 == 0) x += uniform(random, -2, 2) * tolerance;
  }
  return {p[0], p[1], p[2]};
}

V beside(const V& p, const V& at) { return {p.x - at.x, p.y - at.y, p.z - at.z}; }

TEST(FourBoxes, AnswerAsOneAfterTheOther) {
  std::mt19937_64 random(11);
  std::size_t hits = 0, within = 0, ties = 0, found = 0;
  for (int scene = 0; scene < 400; ++scene) {
    const std::vector<PlacedBox> boxes = random_boxes(random, 2 + random() % 7);
    FourBoxes fours[2];
    fill(fours, boxes);
    for (int ray = 0; ray < 200; ++ray) {
      const V p = random_point(random);
      const navjit::Vec3 u = random_direction(random);
      const D v = make_direction<double>(u.x, u.y, u.z);
      if (!is_oblique(v)) continue;
      double best = uniform(random, 0, 20), right = best;
      int hit = -1, right_hit = -1, equal = 0;
      for (std::size_t k = 0; k < boxes.size(); ++k) {
        const double t = distance_to_entry(boxes[k].box, beside(p, boxes[k].at), v, tolerance);
        equal += t == right && right_hit >= 0 ? 1 : 0;
        if (t < right) {
          right = t;
          right_hit = static_cast<int>(k);
        }
      }
      nearest_of_boxes(fours, p, v, tolerance, best, hit);
      ASSERT_EQ(std::bit_cast<std::uint64_t>(best), std::bit_cast<std::uint64_t>(right));
      ASSERT_EQ(hit, right_hit);
      hits += hit >= 0 ? 1 : 0;
      within += best < 0 ? 1 : 0;
      ties += equal > 0 ? 1 : 0;

      const int blocked = static_cast<int>(random() % 9) - 1;
      int right_box = -1;
      for (std::size_t k = 0; k < boxes.size(); ++k) {
        if (static_cast<int>(k) != blocked &&
            contains(boxes[k].box, beside(p, boxes[k].at), v, tolerance)) {
          right_box = static_cast<int>(k);
        }
      }
      ASSERT_EQ(last_box_at(fours, p, v, tolerance, blocked), right_box);
      found += right_box >= 0 ? 1 : 0;
    }
  }
  EXPECT_GT(hits, 1000U);
  EXPECT_GT(within, 1000U);
  EXPECT_GT(ties, 100U);
  EXPECT_GT(found, 1000U);
}

}  // namespace
}  // namespace navjit::test
