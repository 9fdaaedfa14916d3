// The section of a point found by halving is the one found by looking at all; and for rings with
// thick walls one face gives the answer of both.
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

/// For solids with thick walls, counts the rays for which one face suffices: those that start well
/// inside a bore, and those that come in from outside.
struct OneFace {
  int in_bores = 0, from_outside = 0;
};

template <class Shape>
void expect_the_same_with_both_faces(const Solid& solid, double size, Random& random,
                                     OneFace& counts) {
  const Shape& s = *static_cast<const Shape*>(solid.any().shape);
  std::vector<kernels::Section<double>> sections(s.sections, s.sections + s.count);
  bool thick = false;
  for (auto& section : sections) {
    thick |= section.bored == 2;
    if (section.bored == 2) section.bored = 1;
  }
  if (!thick) return;
  Shape both = s;
  both.sections = sections.data();
  constexpr double tol = 1e-9;
  for (int k = 0; k < 40; ++k) {
    const double reach = random.chance(0.5) ? 0.3 * size : size;
    const Vec3 p{random.uniform(-reach, reach), random.uniform(-reach, reach),
                 random.chance(0.2) ? s.z_low : random.uniform(-size, size)};
    const Direction v = random.any_direction();
    const double t = kernels::distance_to_in(both, p, v, tol);
    ASSERT_EQ(kernels::distance_to_in(s, p, v, tol), t);
    if (!(t < size * 100)) continue;
    const bool in_bore = std::any_of(s.sections, s.sections + s.count, [&](const auto& section) {
      return section.bored == 2 && p.z > section.z_low && p.z < section.z_high &&
             kernels::well_in_bore(section, kernels::from_section(section, p), tol);
    });
    ++(in_bore ? counts.in_bores : counts.from_outside);
  }
}

TEST(Sections, OfThickWallsAreMetByOneOfTheirFaces) {
  Random random(29);
  OneFace cones, sides;
  for (int n = 0; n < scaled(3000); ++n) {
    const SolidCase polycone = random_polycone(random), polyhedra = random_polyhedra(random);
    expect_the_same_with_both_faces<kernels::Polycone<double>>(polycone.solid, polycone.size / 3,
                                                               random, cones);
    if (polyhedra.solid.kind != SolidKind::polyhedra) continue;  // convex ones are planes
    expect_the_same_with_both_faces<kernels::Polyhedra<double>>(polyhedra.solid, polyhedra.size / 4,
                                                                random, sides);
  }
  for (const OneFace& counts : {cones, sides}) {
    EXPECT_GT(counts.in_bores, scaled(3000) / 6);
    EXPECT_GT(counts.from_outside, scaled(3000) / 6);
  }
}

}  // namespace
}  // namespace navjit::test
