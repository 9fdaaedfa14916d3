// ROOT's shapes that are made of others, half spaces among them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/support/root_reading.hpp"

namespace navjit {
namespace {

using namespace tests;
using Numbers = std::vector<double>;

class RootBooleans : public RootReading {
 protected:
  std::string refusal_of(const RootPointer& shape) { return refusal(root_world_around(shape)); }
  void expect_refused(const RootPointer& shape, const std::string& why) {
    const std::string message = refusal_of(shape);
    EXPECT_NE(message.find(why), std::string::npos) << message;
  }

  const RootPointer big_ = root_box("big", 3, 3, 3), small_ = root_box("small", 1, 1, 1);
};

TEST_F(RootBooleans, AllKinds) {
  const RootPointer away = root_translation(3, 0, 0);
  for (const auto& [operation, left, middle, right] :
       {std::tuple{"TGeoUnion", true, true, true},
        std::tuple{"TGeoSubtraction", true, false, false},
        std::tuple{"TGeoIntersection", false, true, false}}) {
    const Solid s = solid(root_boolean(operation, big_, small_, {}, away));
    EXPECT_EQ(has(s, {0, 0, 0}), left) << operation;
    EXPECT_EQ(has(s, {25, 0, 0}), middle) << operation;
    EXPECT_EQ(has(s, {35, 0, 0}), right) << operation;
  }
}

TEST_F(RootBooleans, Scales) {
  const RootPointer tube =
      root_object("TGeoTube", "tube", {{"fRmin", 0.0}, {"fRmax", 1.0}, {"fDz", 1.0}});
  const RootPointer factors = root_object("TGeoScale", "", {{"fScale", Numbers{1, 2, 3}}});
  const Solid s =
      solid(root_object("TGeoScaledShape", "egg", {{"fShape", tube}, {"fScale", factors}}));
  EXPECT_STREQ(kind_name(s.kind), "scaled");
  EXPECT_NEAR(capacity(s), std::numbers::pi * 12 * 1000, 1e-6);
  EXPECT_NEAR(s.extent.max.y, 20, 1e-9);
}

TEST_F(RootBooleans, HalfSpacesCutOtherShapes) {
  const RootPointer half = root_half_space({1, 0, 0}, {2, 0, 0});
  // Either operand may be half of space in an intersection.
  for (const RootPointer& shape : {root_boolean("TGeoIntersection", big_, half),
                                   root_boolean("TGeoIntersection", half, big_)}) {
    const Solid s = solid(shape);
    EXPECT_TRUE(has(s, {9, 29, -29}));
    EXPECT_TRUE(has(s, {-29, 29, 29}));
    EXPECT_FALSE(has(s, {11, 0, 0}));
    EXPECT_FALSE(has(s, {-31, 0, 0}));
  }
  Solid s = solid(root_boolean("TGeoSubtraction", big_, half));
  EXPECT_FALSE(has(s, {-29, 29, 29}));
  EXPECT_TRUE(has(s, {11, 0, 0}));
  // The same moved by 1 cm, and turned so that y is what x was.
  s = solid(root_boolean("TGeoIntersection", big_, half, {}, root_translation(1, 0, 0)));
  EXPECT_TRUE(has(s, {19, 0, 0}));
  EXPECT_FALSE(has(s, {21, 0, 0}));
  s = solid(root_boolean("TGeoIntersection", big_, half, {},
                         root_placed(0, 1, 0, {0, -1, 0, 1, 0, 0, 0, 0, 1})));
  EXPECT_TRUE(has(s, {0, 19, 0}));
  EXPECT_FALSE(has(s, {0, 21, 0}));
  // A mirror turns the side, too.
  s = solid(root_boolean("TGeoIntersection", big_, half, {},
                         root_object("TGeoScale", "", {{"fScale", Numbers{-1, 1, 1}}})));
  EXPECT_TRUE(has(s, {-9, 0, 0}));
  EXPECT_FALSE(has(s, {-11, 0, 0}));
}

/// Where the plane's point is, and how long its normal, does not matter.
TEST_F(RootBooleans, HalfSpacesMayBeGivenFarAway) {
  const RootPointer half = root_half_space({1, 1e12, -1e12}, {1e-9, 0, 0});
  const Solid s = solid(root_boolean("TGeoIntersection", big_, half));
  EXPECT_TRUE(has(s, {9.999, 29, -29}));
  EXPECT_FALSE(has(s, {10.001, 0, 0}));
  const RootPointer around = root_half_space({1e12, 0, 0}, {1, 0, 0});
  EXPECT_TRUE(has(solid(root_boolean("TGeoIntersection", big_, around)), {29, 29, 29}));
  const RootPointer apart = root_half_space({-1e12, 0, 0}, {1, 0, 0});
  EXPECT_TRUE(has(solid(root_boolean("TGeoSubtraction", big_, apart)), {-29, 29, 29}));
  expect_refused(root_boolean("TGeoIntersection", big_, apart), "do not meet");
}

/// Random trees with half spaces in them say of points what their operations say of them.
TEST_F(RootBooleans, HalfSpacesMayBeNested) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  struct Plane {
    Numbers point, normal;
    bool holds(const Vec3& p) const {
      return normal[0] * (p.x / 10 - point[0]) + normal[1] * (p.y / 10 - point[1]) +
                 normal[2] * (p.z / 10 - point[2]) <
             0;
    }
  };
  for (int turn = 0; turn < 20; ++turn) {
    std::vector<Plane> planes(4);
    std::vector<RootPointer> halves;
    for (Plane& plane : planes) {
      plane = {{uniform(random), uniform(random), uniform(random)},
               {uniform(random), uniform(random), uniform(random)}};
      halves.push_back(root_half_space(plane.point, plane.normal));
    }
    // Of four planes and a box that holes are in: ((h0 and h1) or h2 less the hole) less, or and,
    // the box. The tree is moved in its box.
    const RootPointer edge = root_boolean("TGeoIntersection", halves[0], halves[1]);
    const RootPointer more = root_boolean("TGeoUnion", edge, halves[2]);
    const RootPointer less = root_boolean("TGeoSubtraction", more, small_);
    const RootPointer moved = root_placed(1, 0.5, 0, {0, -1, 0, 1, 0, 0, 0, 0, 1});
    const bool cut = turn % 2 == 0;
    const Solid s =
        solid(root_boolean(cut ? "TGeoSubtraction" : "TGeoIntersection", big_, less, {}, moved));
    for (int i = 0; i < 200; ++i) {
      const Vec3 p{40 * uniform(random), 40 * uniform(random), 40 * uniform(random)};
      const auto in_box = [](const Vec3& q, double half) {
        return std::abs(q.x) < half && std::abs(q.y) < half && std::abs(q.z) < half;
      };
      const Vec3 q{p.y - 5, -(p.x - 10), p.z};
      const bool tree =
          ((planes[0].holds(q) && planes[1].holds(q)) || planes[2].holds(q)) && !in_box(q, 10);
      EXPECT_EQ(has(s, p), in_box(p, 30) && (cut ? !tree : tree)) << turn;
    }
  }
}

TEST_F(RootBooleans, WhatHasNoEndIsRefused) {
  const RootPointer half = root_half_space({1, 0, 0}, {2, 0, 0});
  const RootPointer other = root_half_space({0, 0, 0}, {0, 1, 0});
  expect_refused(half, "TGeoHalfSpace 'half': half of space has no end");
  for (const RootPointer& shape :
       {root_boolean("TGeoUnion", big_, half), root_boolean("TGeoUnion", half, big_),
        root_boolean("TGeoSubtraction", half, big_),
        root_boolean("TGeoIntersection", half, other)}) {
    expect_refused(shape, "TGeoCompositeShape 'boolean': half of space has no end, nor has this");
  }
  const RootPointer factors = root_object("TGeoScale", "", {{"fScale", Numbers{1, 2, 3}}});
  const RootPointer scaled =
      root_object("TGeoScaledShape", "scaled", {{"fShape", half}, {"fScale", factors}});
  expect_refused(root_boolean("TGeoIntersection", big_, scaled), "has no end");
  // Planes that are none.
  const auto cut = [&](const Numbers& point, const Numbers& normal) {
    return root_boolean("TGeoSubtraction", big_, root_half_space(point, normal));
  };
  expect_refused(cut({0, 0, 0}, {0, 0, 0}), "its plane has no direction");
  expect_refused(cut({0, NAN, 0}, {1, 0, 0}), "a number of fP is not finite");
  expect_refused(cut({0, 0, 0}, {1, INFINITY, 0}), "a number of fN is not finite");
  expect_refused(cut({0, 0}, {1, 0, 0}), "it has no 3 numbers fP");
}

/// Those without an end are read once for each boolean that they are in.
TEST_F(RootBooleans, HalfSpacesThatMultiplyAreRefused) {
  RootPointer many = root_half_space({0, 0, 0}, {1, 0, 0});
  for (int i = 0; i < 40; ++i) many = root_boolean("TGeoUnion", many, many);
  expect_refused(root_boolean("TGeoSubtraction", big_, many), "more than 10000 parts");
}

/// A plate of hundreds of holes, cut one after the other, is one solid less one union of few
/// levels.
TEST_F(RootBooleans, ChainsMayBeLongerThanBooleansMayBeDeep) {
  RootPointer plate = root_box("plate", 1000, 3, 3);
  constexpr int holes = 600;
  for (int i = 0; i < holes; ++i) {
    plate = root_boolean("TGeoSubtraction", plate, small_, {}, root_translation(3 * i - 900, 0, 0));
  }
  const Solid s = solid(plate);
  EXPECT_FALSE(has(s, {-9000, 0, 0}));
  EXPECT_FALSE(has(s, {10.0 * (3 * holes - 903), 0, 0}));
  EXPECT_TRUE(has(s, {-9015, 0, 0}));
}

TEST_F(RootBooleans, AreChainedAndNestedToALimit) {
  const auto chain = [&](int links, const RootPointer& matrix) {
    RootPointer shape = small_;
    for (int i = 1; i < links; ++i) shape = root_boolean("TGeoUnion", shape, small_, matrix);
    return shape;
  };
  EXPECT_EQ(refusal_of(chain(1000, {})), "");
  expect_refused(chain(1001, {}), "more than 1000 shapes are within one another");
  // A union that is moved goes on with a chain, and what is cut from does not.
  const RootPointer moved = root_translation(0.01, 0, 0);
  EXPECT_EQ(refusal_of(chain(300, moved)), "");
  const auto nest = [&](int levels) {
    RootPointer shape = big_;
    for (int i = 1; i < levels; ++i) shape = root_boolean("TGeoSubtraction", shape, small_, moved);
    return shape;
  };
  EXPECT_EQ(refusal_of(nest(200)), "");
  expect_refused(nest(202), "nested more than 200 deep");
  // One that is its own operand.
  const RootPointer self = root_boolean("TGeoUnion", big_, small_);
  const RootPointer node = std::get<RootPointer>(self->members[0].second);
  RootValue& left = std::get<RootBase>(node->members[0].second).part->members[0].second;
  left = self;
  expect_refused(self, "within one another");
  // The pointers of the test's own circle.
  left = RootPointer{};
}

}  // namespace
}  // namespace navjit
