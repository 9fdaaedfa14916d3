// A moved union is the union of its moved parts, and a solid that is moved twice is moved once.
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/solids/extent.hpp"
#include "geometry/solids/make.hpp"
#include "navjit/solids.hpp"
#include "navjit/transformation.hpp"
#include "tests/geometry/kernels/random.hpp"

namespace navjit::test {
namespace {

constexpr double tolerance = 1e-10;

SolidFrame random_frame(Random& random) {
  SolidFrame frame;
  for (double& x : frame.translation) x = random.uniform(-5, 5);
  if (random.chance(0.3)) return frame;
  rotation_from_angles(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3),
                       frame.rotation);
  return frame;
}

Transformation transformation(const SolidFrame& frame) {
  Transformation t{{}, {}, true};
  std::copy_n(frame.translation, 3, t.translation);
  std::copy_n(frame.rotation, 9, t.rotation);
  return t;
}

Solid random_part(Random& random) {
  const double a = random.uniform(0.5, 3), b = random.uniform(0.5, 3), c = random.uniform(0.5, 3);
  return random.chance(0.5) ? make_box("box", a, b, c) : make_tube("tube", 0, a, c, 0, 7);
}

Solid random_union(Random& random, int parts) {
  Solid made = random_part(random);
  for (int i = 1; i < parts; ++i) {
    made = make_union("union", made, make_placed("p", random_part(random), random_frame(random)));
  }
  return made;
}

Direction local(const Transformation& t, const Direction& v) {
  return kernels::make_direction(rotate_row(t.rotation, v.x, v.y, v.z),
                                 rotate_row(t.rotation + 3, v.x, v.y, v.z),
                                 rotate_row(t.rotation + 6, v.x, v.y, v.z));
}

/// Expects that `moved` is `solid` placed by `frame`.
void expect_moved(Random& random, const Solid& moved, const Solid& solid, const SolidFrame& frame,
                  int& met) {
  const Transformation t = transformation(frame);
  for (int n = 0; n < 60; ++n) {
    const Vec3 p{random.uniform(-15, 15), random.uniform(-15, 15), random.uniform(-15, 15)};
    const Direction v = random.direction();
    const Vec3 q = to_local(t, p);
    const Direction w = local(t, v);
    ASSERT_EQ(contains(moved.any(), p, v, tolerance), contains(solid.any(), q, w, tolerance));
    const bool within = contains(moved.any(), p, v, tolerance);
    const double d = within ? distance_to_out(moved.any(), p, v, tolerance)
                            : distance_to_in(moved.any(), p, v, tolerance);
    const double expected = within ? distance_to_out(solid.any(), q, w, tolerance)
                                   : distance_to_in(solid.any(), q, w, tolerance);
    ASSERT_EQ(std::isfinite(d), std::isfinite(expected));
    if (!std::isfinite(d)) continue;
    ASSERT_NEAR(d, expected, 1e-9);
    ++met;
    const Vec3 at = advance(p, v, d);
    const Extent box = inflated(moved.extent, 1e-9);
    EXPECT_TRUE(at.x >= box.min.x && at.x <= box.max.x && at.y >= box.min.y && at.y <= box.max.y &&
                at.z >= box.min.z && at.z <= box.max.z);
  }
}

TEST(MovedUnions, AreUnionsOfMovedParts) {
  Random random(1);
  int met = 0;
  for (int n = 0; n < scaled(300); ++n) {
    const Solid made = random_union(random, random.integer(2, 9));
    const SolidFrame frame = random_frame(random);
    const Solid moved = make_placed("moved", made, frame);
    ASSERT_EQ(moved.kind, SolidKind::union_of);
    EXPECT_EQ(moved.name, "moved");
    expect_moved(random, moved, made, frame, met);
  }
  EXPECT_GT(met, scaled(300));
}

TEST(MovedUnions, WhatIsMovedTwiceIsMovedOnce) {
  Random random(2);
  int met = 0;
  for (int n = 0; n < scaled(300); ++n) {
    const Solid part = random_part(random);
    const SolidFrame inner = random_frame(random), outer = random_frame(random);
    const Solid once = make_placed("once", part, inner), twice = make_placed("twice", once, outer);
    ASSERT_EQ(twice.kind, SolidKind::placed);
    const auto& shape = *static_cast<const kernels::AnyPlaced<double>*>(twice.any().shape);
    EXPECT_EQ(shape.solid.kind, part.kind);
    expect_moved(random, twice, once, outer, met);
  }
  EXPECT_GT(met, scaled(300) / 3);
}

TEST(MovedUnions, MayBeReflected) {
  Random random(3);
  int met = 0;
  const SolidFrame mirror{{1, 2, 3}, {-1, 0, 0, 0, 1, 0, 0, 0, 1}};
  const Solid made = random_union(random, 4);
  const Solid moved = make_placed("moved", made, mirror);
  ASSERT_EQ(moved.kind, SolidKind::union_of);
  expect_moved(random, moved, made, mirror, met);
}

}  // namespace
}  // namespace navjit::test
