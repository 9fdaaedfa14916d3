// Sides that twist a little are near to planes, and these planes give the answer that all sides
// would give.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "geometry/solids/arb8.hpp"
#include "geometry/solids/parts.hpp"
#include "geometry/solids/widen.hpp"
#include "tests/geometry/kernels/random_flat_solids.hpp"

namespace navjit::test {
namespace {

using Shape = kernels::Arb8<double>;
using Quad = __float128;
constexpr double tolerance = 1e-11;
constexpr double infinity = std::numeric_limits<double>::infinity();

const Shape* arb8_in(const SolidCase& made) {
  return made.solid.kind == SolidKind::arb8 ? static_cast<const Shape*>(made.solid.any().shape)
                                            : nullptr;
}

Vec3 point_about(Random& random, const Shape& s, double room) {
  return {random.uniform(-room, room) * s.hx, random.uniform(-room, room) * s.hy,
          random.uniform(-room, room) * s.hz};
}

/// The value of the side's function, and its gradient.
double value_of(const kernels::TwistedFace<double>& f, const Vec3& p) {
  return (f.a * p.x + f.b * p.y + f.c * p.z + f.d) * p.z + f.e * p.x + f.f * p.y + f.g;
}
double rate_of(const kernels::TwistedFace<double>& f, const Vec3& p, const Direction& v) {
  return (f.a * p.z + f.e) * v.x + (f.b * p.z + f.f) * v.y +
         (f.a * p.x + f.b * p.y + 2 * f.c * p.z + f.d) * v.z;
}

TEST(SidePlanes, SidesAreAsNearAsTheySay) {
  Random random(3);
  constexpr double room = 1 + 1.0 / 32;
  int useful = 0, all = 0, tight = 0;
  for (int n = 0; n < scaled(3000); ++n) {
    const SolidCase made =
        random.chance(0.5) ? random_nearly_flat_arb8(random) : random_arb8(random);
    const Shape* s = arb8_in(made);
    if (s == nullptr) continue;
    const double size = s->hx + s->hy + s->hz;
    for (int i = 0; i < 4; ++i) {
      ++all;
      const kernels::TwistedFace<double>& side = side_of(*s, i);
      double furthest = 0;
      const double reach = lanes_from(s->planes.reach)[i], lean = lanes_from(s->planes.lean)[i];
      if (!(reach < infinity)) continue;
      ++useful;
      for (int k = 0; k < 30; ++k) {
        // A point of the box's, moved on to the side along its plane's normal.
        Vec3 p = point_about(random, *s, room);
        const auto normal = [&](const kernels::FourOf<double>& c) { return lanes_from(c)[i]; };
        const Direction across =
            kernels::make_direction(normal(s->planes.a), normal(s->planes.b), normal(s->planes.c));
        for (int turn = 0; turn < 60; ++turn) {
          p = advance(p, across, -value_of(side, p) / rate_of(side, p, across));
        }
        if (!(std::abs(p.x) <= room * s->hx && std::abs(p.y) <= room * s->hy &&
              std::abs(p.z) <= room * s->hz)) {
          continue;
        }
        const Direction v = random.direction();
        const auto planes = planes_near(s->planes, p, v);
        furthest = std::max(furthest, std::abs(planes.beyond[i]));
        EXPECT_LE(std::abs(planes.beyond[i]), reach + 1e-13 * size);
        // Where the side is crossed it is crossed as the plane is.
        if (planes.nv[i] > lean) EXPECT_GT(rate_of(side, p, v), 0);
        if (planes.nv[i] < -lean) EXPECT_LT(rate_of(side, p, v), 0);
      }
      tight += furthest > reach / 20;
    }
  }
  EXPECT_GT(useful, all / 3);
  // No more is claimed than needs be.
  EXPECT_GT(tight, useful / 3);
}

struct Tally {
  int inside = 0, entries = 0, exits = 0, by_one_side = 0, asked = 0;
};

/// Compares the answers of the planes for one ray with those of all sides with 113 bits.
void compare(const Shape& s, const kernels::Arb8<Quad>& wide, const Vec3& p, const Direction& v,
             double size, Tally& tally) {
  const kernels::Vec3<Quad> wide_p{p.x, p.y, p.z};
  const auto wide_v = kernels::make_direction(Quad(v.x), Quad(v.y), Quad(v.z));
  const bool in = contains(s, p, v, tolerance);
  if (in != contains(wide, wide_p, wide_v, Quad(tolerance))) {
    // Only rounding may decide otherwise.
    const auto off = static_cast<double>(beyond_arb8(wide, wide_p));
    EXPECT_LT(std::abs(off), 4 * tolerance + 1e-13 * size);
    return;
  }
  const auto expected =
      static_cast<double>(in ? distance_to_out(wide, wide_p, wide_v, Quad(tolerance))
                             : distance_to_in(wide, wide_p, wide_v, Quad(tolerance)));
  const double found =
      in ? distance_to_out(s, p, v, tolerance) : distance_to_in(s, p, v, tolerance);
  const auto depth = static_cast<double>(-beyond_arb8(wide, wide_p));
  const double safety = in ? safety_to_out(s, p) : safety_to_in(s, p);
  EXPECT_GE(safety, 0);
  tally.inside += in;
  if (!(expected < infinity) || !(found < infinity)) {
    // By an edge, or not.
    if (expected < infinity || found < infinity) {
      const double t = std::min(expected, found);
      const auto at = kernels::advance(wide_p, wide_v, Quad(t));
      EXPECT_LT(std::abs(static_cast<double>(beyond_arb8(wide, at))), 1e-9 * size + 1e-9);
    }
    return;
  }
  EXPECT_LE(safety, found + 4 * tolerance + 1e-13 * size);
  if (depth > 1e-3 * size) EXPECT_GT(safety, 0.5 * depth);
  // A ray that grazes a side has no better place than where it comes near that.
  const auto at = kernels::advance(wide_p, wide_v, Quad(found));
  const auto off = static_cast<double>(beyond_arb8(wide, at));
  EXPECT_LT(std::abs(off), 4 * tolerance + 1e-12 * size);
  if (std::abs(found - expected) > 1e-9 * size) {
    EXPECT_LT(std::abs(static_cast<double>(beyond_arb8(
                  wide, kernels::advance(wide_p, wide_v, Quad((found + expected) / 2))))),
              1e-8 * size);
  }
  if (in) {
    ++tally.exits;
    const auto planes = planes_near(s.planes, p, v);
    const auto earliest = earliest_exits(planes, clear_of(s.planes, tolerance));
    for (int i = 0; i < 4; ++i) tally.asked += earliest[i] < found;
  } else {
    ++tally.entries;
    const double forever = infinity;
    const auto entry = entry_by_planes(planes_near(s.planes, p, v), clear_of(s.planes, tolerance),
                                       lanes_from(s.planes.lean), -forever, forever);
    tally.by_one_side += entry.side != kernels::Entry::unknown || std::abs(v.z) < 1e-3;
  }
}

Tally compare_many(SolidCase (*make)(Random&), unsigned seed) {
  Random random(seed);
  Tally tally;
  for (int n = 0; n < scaled(1500); ++n) {
    const SolidCase made = make(random);
    const Shape* s = arb8_in(made);
    if (s == nullptr) continue;
    const WideSolid<Quad> owner(made.solid);
    const auto& wide = *static_cast<const kernels::Arb8<Quad>*>(owner.any().shape);
    for (int k = 0; k < 40; ++k) {
      Vec3 p = point_about(random, *s, 1.3);
      const Direction v = random.any_direction();
      // A third of them start on a side or end, and half of these head back.
      if (random.chance(0.3)) {
        const Direction w = random.direction();
        const bool in = contains(*s, p, w, tolerance);
        const double t =
            in ? distance_to_out(*s, p, w, tolerance) : distance_to_in(*s, p, w, tolerance);
        if (t < infinity) p = advance(p, w, t);
      }
      compare(*s, wide, p, v, made.size, tally);
      if (testing::Test::HasFailure()) return tally;
    }
  }
  return tally;
}

TEST(SidePlanes, TellWhatAllSidesSayAndAskFew) {
  const Tally tally = compare_many(random_nearly_flat_arb8, 5);
  EXPECT_GT(tally.exits, scaled(3000));
  EXPECT_GT(tally.entries, scaled(3000));
  EXPECT_LT(tally.asked, 2 * tally.exits);
  EXPECT_GT(tally.by_one_side, tally.entries / 2);
}

TEST(SidePlanes, ChangeNothingWhereSidesTwist) {
  const Tally tally = compare_many(random_arb8, 7);
  EXPECT_GT(tally.exits, scaled(3000));
  EXPECT_GT(tally.entries, scaled(3000));
}

TEST(SidePlanes, AreOfNoUseToSolidsThatAreHardlyLargerThanTheTolerance) {
  const navjit::PlanarPoint corners[8] = {{-1e-7, -1e-7}, {-1e-7, 1e-7},  {1e-7, 1e-7},
                                          {1e-7, -1e-7},  {-1e-7, -1e-7}, {-1e-7, 1e-7},
                                          {1e-7, 1e-7},   {1e-7, -0.9e-7}};
  const Solid solid = make_arb8("s", 1e-7, corners);
  ASSERT_EQ(solid.kind, SolidKind::arb8);
  EXPECT_EQ(static_cast<const Shape*>(solid.any().shape)->planes.reach.a, infinity);
}

}  // namespace
}  // namespace navjit::test
