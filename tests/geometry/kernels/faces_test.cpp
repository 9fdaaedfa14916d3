// Several faces asked at once answer as one by one: sides of polyhedra, planes of convex bodies.
#include <gtest/gtest.h>

#include <bit>

#include "tests/geometry/kernels/random_flat_solids.hpp"
#include "tests/geometry/kernels/random_solids.hpp"

namespace navjit::test {
namespace {

using Polyhedra = kernels::Polyhedra<double>;
using Face = kernels::ConicalFace<double>;
using V = kernels::Vec3<double>;

const Polyhedra& polyhedra_of(const Solid& s) {
  return *static_cast<const Polyhedra*>(s.any().shape);
}

/// A polyhedra of one to forty sides, over the whole circle or a part of it.
Solid random_solid(Random& random) {
  const std::vector<ZPlane> planes{{-1, 0.2, 0.9}, {0.3, 0.3, 1.2}, {1, 0.1, 1.2}};
  const bool whole = random.chance(0.7);
  return make_polyhedra("polyhedra", planes, random.integer(whole ? 3 : 1, 40),
                        random.uniform(0, 6), whole ? 2 * std::numbers::pi : 2.5);
}

/// A point near a face: some on a side's plane, and some on the edge of two.
V point_near(Random& random, const Polyhedra& s, const Face& f) {
  const auto& n = s.sides[random.integer(0, s.side_count - 1)];
  const double z = random.uniform(0, 1), r = (f.radius + f.slope * z) / f.cosine;
  const double along = random.chance(0.3) ? 0 : random.uniform(-1, 1);
  if (random.chance(0.5)) return {r * n.x - along * n.y, r * n.y + along * n.x, z};
  return {random.uniform(-2, 2), random.uniform(-2, 2), z};
}

TEST(EightSides, AnswerAsOneByOne) {
  Random random(17);
  int ahead = 0, past = 0;
  for (int n = 0; n < scaled(20000); ++n) {
    const Solid solid = random_solid(random);
    const Polyhedra& s = polyhedra_of(solid);
    const Face& f = random.chance(0.5) ? s.sections[0].outer : s.sections[1].inner;
    const double tolerance = random.chance(0.5) ? 1e-9 : 0;
    for (int ray = 0; ray < 10; ++ray) {
      const V p = point_near(random, s, f);
      const Direction v = random.any_direction();
      const kernels::Span<double> at_once = face_span(s, f, p, v, tolerance);
      const kernels::Span<double> one_by_one = kernels::face_span<double>(s, f, p, v, tolerance);
      // What a ray does not meet is left as soon as that is known: then numbers mean nothing.
      ASSERT_EQ(is_ahead(at_once), is_ahead(one_by_one));
      if (!is_ahead(at_once)) {
        ++past;
        continue;
      }
      ++ahead;
      ASSERT_EQ(at_once.enter, one_by_one.enter);
      ASSERT_EQ(at_once.leave, one_by_one.leave);
      ASSERT_EQ(at_once.until, one_by_one.until);
    }
  }
  EXPECT_GT(ahead, scaled(20000));
  EXPECT_GT(past, scaled(20000));
}

TEST(EightSides, HoldAPointThatAllOfThemHold) {
  Random random(18);
  int in = 0, close = 0;
  for (int n = 0; n < scaled(20000); ++n) {
    const Solid solid = random_solid(random);
    const Polyhedra& s = polyhedra_of(solid);
    const Face& f = random.chance(0.5) ? s.sections[0].outer : s.sections[1].inner;
    for (int point = 0; point < 10; ++point) {
      const V p = point_near(random, s, f);
      const Direction v = random.any_direction();
      bool all = true;
      double across = -INFINITY;
      for (int i = 0; i < s.side_count; ++i) {
        const double of_side = s.sides[i].x * p.x + s.sides[i].y * p.y;
        const double beyond = f.cosine * of_side - (f.radius + f.slope * p.z);
        const double nv = f.cosine * (s.sides[i].x * v.x + s.sides[i].y * v.y) - f.slope * v.z;
        all &= !kernels::beyond_face(beyond, nv, 1e-9);
        if (std::abs(beyond) <= 1e-9) ++close;
        across = std::max(across, of_side);
      }
      ASSERT_EQ(in_face(s, f, p, v, 1e-9), all);
      ASSERT_EQ(largest_across(s, p), across);
      in += all ? 1 : 0;
    }
  }
  EXPECT_GT(in, scaled(10000));
  EXPECT_GT(close, scaled(10000)) << "points on faces, where directions decide";
}

TEST(EightSides, OfALastGroupThatIsNotFullAreThere) {
  for (int sides = 3; sides <= 40; ++sides) {
    const std::vector<ZPlane> planes{{-1, 0.2, 1}, {1, 0.2, 1}};
    const Solid solid = make_polyhedra("polyhedra", planes, sides, 0, 2 * std::numbers::pi);
    const Polyhedra& s = polyhedra_of(solid);
    ASSERT_EQ(s.group_count, (sides + 7) / 8);
    for (int i = 0; i < sides; ++i) {
      const auto& n = s.sides[i];
      EXPECT_EQ(largest_across(s, V{n.x, n.y, 0}), n.x * n.x + n.y * n.y);
    }
  }
}

/// A point in or near the solid, now and then where a face is.
V point_at(Random& random, const Solid& solid) {
  const Extent& e = solid.extent;
  const auto within = [&](double low, double high) {
    const double margin = 0.2 * (high - low);
    return random.uniform(low - margin, high + margin);
  };
  V p{within(e.min.x, e.max.x), within(e.min.y, e.max.y), within(e.min.z, e.max.z)};
  if (random.chance(0.2)) p.z = random.chance(0.5) ? e.min.z : e.max.z;
  const Direction v = random.any_direction();
  const double t = kernels::distance_to_out(solid.any(), p, v, 1e-9);
  return t > 0 && t < 1e9 && random.chance(0.3) ? kernels::advance(p, v, t) : p;
}

/// Compares the kernels for several faces with the templates that ask one face after the other.
template <class Shape>
void expect_the_same(Random& random, const Solid& solid, int& met) {
  const Shape& s = *static_cast<const Shape*>(solid.any().shape);
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); };
  const double tolerance = random.chance(0.7) ? 1e-9 : 0;
  for (int n = 0; n < 60; ++n) {
    const V p = point_at(random, solid);
    const Direction v = random.any_direction();
    ASSERT_EQ(contains(s, p, v, tolerance), kernels::contains<double>(s, p, v, tolerance));
    const double in = distance_to_entry(s, p, v, tolerance);
    ASSERT_EQ(bits(in), bits(kernels::distance_to_entry<double>(s, p, v, tolerance)));
    ASSERT_EQ(bits(distance_to_in(s, p, v, tolerance)),
              bits(kernels::distance_to_in<double>(s, p, v, tolerance)));
    ASSERT_EQ(bits(distance_to_out(s, p, v, tolerance)),
              bits(kernels::distance_to_out<double>(s, p, v, tolerance)));
    if constexpr (std::is_same_v<Shape, kernels::Hull<double>>) {
      ASSERT_EQ(bits(hull_distance(s, p)), bits(kernels::hull_distance<double>(s, p)));
    }
    met += in < 1e300 ? 1 : 0;
  }
}

TEST(SeveralFaces, AnswerAsOneByOne) {
  Random random(19);
  int met = 0;
  for (int n = 0; n < scaled(3000); ++n) {
    const Solid trd = random_trd(random).solid, trap = random_trap(random).solid;
    ASSERT_EQ(trd.kind, SolidKind::trd);
    ASSERT_EQ(trap.kind, SolidKind::trap);
    expect_the_same<kernels::Trd<double>>(random, trd, met);
    expect_the_same<kernels::Trap<double>>(random, trap, met);
    for (const Solid& hull : {random_tet(random).solid, random_para(random).solid}) {
      if (hull.kind == SolidKind::hull) expect_the_same<kernels::Hull<double>>(random, hull, met);
    }
  }
  EXPECT_GT(met, scaled(3000) * 30);
}

/// Of three to forty corners: up to 42 planes, so that a last group is full or not.
TEST(SeveralFaces, OfPrismsWithManyAreThere) {
  Random random(20);
  int met = 0;
  for (int corners = 3; corners <= 40; ++corners) {
    std::vector<navjit::PlanarPoint> polygon;
    for (int i = 0; i < corners; ++i) {
      const double phi = 2 * std::numbers::pi * i / corners;
      polygon.push_back({std::cos(phi), std::sin(phi)});
    }
    const std::vector<ExtrudedSection> sections{{-1, 0, 0, 1}, {1, 0, 0, 0.8}};
    const Solid solid = make_extruded("extruded", polygon, sections);
    ASSERT_EQ(solid.kind, SolidKind::hull);
    const auto& s = *static_cast<const kernels::Hull<double>*>(solid.any().shape);
    ASSERT_EQ(s.count, corners + 2);
    ASSERT_EQ(s.group_count, (s.count + 7) / 8);
    for (int i = 0; i < 40; ++i) expect_the_same<kernels::Hull<double>>(random, solid, met);
  }
  EXPECT_GT(met, 15000);
}

}  // namespace
}  // namespace navjit::test
