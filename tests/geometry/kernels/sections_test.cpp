// A point's section, found by halves, is the one that looking at all of them finds.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/geometry/kernels/random_solids.hpp"

namespace navjit::test {
namespace {

/// Planes at different distances, none of them opposite another; more than 4 sections and fewer.
std::vector<ZPlane> pipe(Random& random, int sections) {
  std::vector<ZPlane> planes;
  double z = random.uniform(-20, 3);
  for (int i = 0; i <= sections; ++i) {
    const double r = random.uniform(3, 6);
    planes.push_back({z, random.chance(0.3) ? 0 : r - 1, r});
    z += random.uniform(0.1, 3);
  }
  return planes;
}

TEST(Sections, HoldAPointThatOneOfThemHolds) {
  Random random(23);
  int in = 0, on_planes = 0;
  for (int n = 0; n < scaled(600); ++n) {
    const std::vector<ZPlane> planes = pipe(random, random.integer(2, 24));
    const Solid whole = make_polycone("whole", planes, 0, 7);
    std::vector<Solid> parts;
    for (std::size_t i = 0; i + 1 < planes.size(); ++i) {
      parts.push_back(make_polycone("part", std::vector{planes[i], planes[i + 1]}, 0, 7));
    }
    for (int k = 0; k < 100; ++k) {
      const bool on_plane = random.chance(0.3);
      const double z = on_plane ? planes[static_cast<std::size_t>(random.integer(
                                             0, static_cast<int>(planes.size()) - 1))]
                                          .z +
                                      (random.chance(0.5) ? 0 : random.uniform(-1e-9, 1e-9))
                                : random.uniform(planes.front().z - 1, planes.back().z + 1);
      const Vec3 p{random.uniform(-6, 6), random.uniform(-6, 6), z};
      const Direction v = random.any_direction();
      const bool expected = std::any_of(parts.begin(), parts.end(), [&](const Solid& part) {
        return kernels::contains(part.any(), p, v, 1e-9);
      });
      ASSERT_EQ(kernels::contains(whole.any(), p, v, 1e-9), expected) << "solid " << n;
      in += expected ? 1 : 0;
      on_planes += on_plane ? 1 : 0;
    }
  }
  EXPECT_GT(in, scaled(600) * 10);
  EXPECT_GT(on_planes, scaled(600) * 20);
}

}  // namespace
}  // namespace navjit::test
