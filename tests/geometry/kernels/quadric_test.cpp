// Short ways of solids behind quadrics give the same results as the long ones, and are taken.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/solids/solid.hpp"
#include "tests/geometry/kernels/random.hpp"

namespace navjit::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
using Solids = kernels::QuadricSolid<double>;
using V = kernels::Vec3<double>;

const Solids& quadric_of(const Solid& s) { return *static_cast<const Solids*>(s.any().shape); }

Solid random_solid(Random& random) {
  const double a = random.scale(0.1, 100), b = random.scale(0.1, 100), c = random.scale(0.1, 100);
  switch (random.integer(0, 3)) {
    case 0:
      return make_ellipsoid("e", a, b, c, -c * random.uniform(0.1, 1), c);
    case 1:
      return make_eltube("t", a, b, c);
    case 2:
      return make_elcone("c", a / c, b / c, 2 * c, c);
    default:
      return make_paraboloid("p", a / 2, a, b);
  }
}
V point_about(Random& random, const Solid& s, double reach) {
  const Vec3 &low = s.extent.min, &high = s.extent.max;
  const auto at = [&](double a, double b) {
    return (a + b) / 2 + reach * random.uniform(-0.5, 0.5) * (b - a);
  };
  return {at(low.x, high.x), at(low.y, high.y), at(low.z, high.z)};
}

TEST(Quadrics, WhatIsOffTheSurfaceIsToldWithoutARoot) {
  Random random(61);
  int told = 0, off = 0;
  for (int n = 0; n < scaled(200000); ++n) {
    const Solid solid = random_solid(random);
    const kernels::Quadric<double>& f = quadric_of(solid).outer;
    V p = point_about(random, solid, 1.5);
    const Direction v = random.any_direction();
    const double tolerance = random.scale(1e-12, 1e-6);
    // Half of them within some tolerances of it.
    if (random.chance(0.5)) {
      const auto q = form_at(f, p, v);
      const double t = (-q.b + std::sqrt(std::max(q.b * q.b - q.a * q.c, 0.0))) / q.a;
      if (!std::isfinite(t)) continue;
      p = advance(p, v, t + tolerance * random.uniform(-5, 5));
    }
    const auto q = form_at(f, p, v);
    const double beyond = std::abs(form_distance(q));
    off += beyond > 4 * tolerance;
    if (!is_off_surface(q, tolerance)) continue;
    ++told;
    EXPECT_GT(beyond, tolerance) << "point " << n;
  }
  EXPECT_GT(off, scaled(200000) / 3);
  EXPECT_GT(told, off * 0.99);
}

/// As for solids of any faces: finds all parts of the ray, and where the first of them begins.
double entry_by_spans(const Solids& s, const V& p, const Direction& v, double tolerance) {
  const double shift = kernels::approach(s.hx, s.hy, s.z_low, s.z_high, p, v);
  if (!(shift < infinity)) return infinity;
  const V q = shift > 0 ? advance(p, v, shift) : p;
  const kernels::SpanPair<double> body[] = {
      one_span(kernels::slab_span(s.z_low, s.z_high, p, v, tolerance)),
      moved_by(form_spans(s.outer, q, v, tolerance), shift)};
  const kernels::SpanPair<double> hole[] = {kernels::no_spans<double>()};
  const double t = first_entry(body, hole);
  return t < 0 ? distance_from_within(s, p, tolerance) : t;
}

TEST(Quadrics, AreEnteredWhereThePartsOfTheRaySay) {
  Random random(62);
  int met = 0, missed = 0, grazed = 0;
  for (int n = 0; n < scaled(300000); ++n) {
    const Solid solid = random_solid(random);
    const Solids& s = quadric_of(solid);
    const double tolerance = random.chance(0.5) ? 1e-9 : 1e-12;
    const double far = random.chance(0.2) ? 1e4 : 4;
    V p = point_about(random, solid, far);
    Direction v = random.any_direction();
    if (random.chance(0.3)) {
      // Towards a point of the rim, where the face and a plane meet, or a tangent.
      const V rim = point_about(random, solid, 1);
      const double length = std::hypot(rim.x - p.x, rim.y - p.y, rim.z - p.z);
      if (!(length > 0)) continue;
      v = kernels::make_direction((rim.x - p.x) / length, (rim.y - p.y) / length,
                                  (rim.z - p.z) / length);
      const auto q = form_at(s.outer, p, v);
      grazed += std::abs(q.b * q.b - q.a * q.c) < 1e-3 * q.b * q.b;
    }
    const double t = distance_to_in(s, p, v, tolerance);
    ASSERT_EQ(t, entry_by_spans(s, p, v, tolerance)) << "ray " << n;
    ++(t < infinity ? met : missed);
  }
  EXPECT_GT(met, scaled(300000) / 20);
  EXPECT_GT(missed, scaled(300000) / 20);
  EXPECT_GT(grazed, 0);
}

/// How far from the face a point is, mm, computed with more digits.
long double beside_face(const kernels::Quadric<double>& f, const V& p, const Direction& v,
                        double t) {
  const kernels::Quadric<long double> g{f.a, f.b, f.c, f.d, f.e, f.origin};
  const kernels::Vec3<long double> at{static_cast<long double>(t) * v.x + p.x,
                                      static_cast<long double>(t) * v.y + p.y,
                                      static_cast<long double>(t) * v.z + p.z};
  return std::abs(kernels::face_distance(g, at));
}

TEST(Quadrics, CrossingsOfEllipsoidsAndEllipticalTubesFromNearbyNeedNoPolish) {
  Random random(65);
  int out = 0, in = 0;
  for (int n = 0; n < scaled(200000); ++n) {
    const double a = random.scale(0.1, 100), b = random.scale(0.1, 100), c = random.scale(0.1, 100);
    const Solid solid = random.chance(0.5) ? make_ellipsoid("e", a, b, c, -c, c)
                                           : make_eltube("t", a, b, 1000 * (a + b + c));
    const Solids& s = quadric_of(solid);
    V p{a * random.uniform(-1, 1), b * random.uniform(-1, 1), c * random.uniform(-1, 1)};
    const Direction v = random.any_direction();
    const bool within = contains(s, p, v, 1e-9);
    if (!within && random.chance(0.5)) p = advance(p, v, -random.scale(1e-3, 1e4));
    const auto q = form_at(s.outer, p, v);
    const double t = within ? distance_to_out(s, p, v, 1e-9) : distance_to_in(s, p, v, 1e-9);
    if (!(t > 0) || !(t < infinity)) continue;
    // Through the face, not through a plane.
    const double z = p.z + t * v.z;
    if (z > 0.999 * s.z_high || z < 0.999 * s.z_low) continue;
    const double largest = std::max({a, b, std::abs(z)});
    const double rounding = 4e-16 * (4 * largest + t);
    EXPECT_LE(beside_face(s.outer, p, v, t), rounding)
        << "ray " << n << (within ? " out" : " in") << " at " << t;
    if (within) {
      EXPECT_FALSE(needs_polish(s.outer, q)) << "ray " << n;
      ++out;
    } else {
      ++in;
    }
  }
  EXPECT_GT(out, scaled(200000) / 5);
  EXPECT_GT(in, scaled(200000) / 20);
  // What is far, or bends in another way, loses digits.
  const auto needs = [](const Solid& s, const V& p) {
    const kernels::Quadric<double>& f = quadric_of(s).outer;
    return needs_polish(f, form_at(f, p, kernels::make_direction(1.0, 0.0, 0.0)));
  };
  EXPECT_TRUE(needs(make_ellipsoid("e", 1, 2, 3, -3, 3), {-100, 0, 0}));
  EXPECT_TRUE(needs(make_elcone("c", 1, 1, 2, 1), {0, 0, 0}));
  EXPECT_TRUE(needs(make_paraboloid("p", 1, 2, 3), {0, 0, 0}));
}

TEST(Slabs, AreClippedToAsFaceByFace) {
  Random random(63);
  for (int n = 0; n < scaled(200000); ++n) {
    const double low = random.uniform(-5, 0), high = random.uniform(0, 5);
    const double tolerance = random.chance(0.5) ? 1e-9 : 0.1;
    V p{0, 0, random.uniform(-8, 8)};
    if (random.chance(0.3))
      p.z = (random.chance(0.5) ? low : high) + tolerance * random.uniform(-2, 2);
    const Direction v = random.any_direction();
    kernels::Span<double> span = kernels::whole_ray<double>();
    clip_face(span, p.z - high, v.z, tolerance);
    clip_face(span, low - p.z, -v.z, tolerance);
    const kernels::Span<double> at_once = kernels::slab_span(low, high, p, v, tolerance);
    ASSERT_EQ(at_once.enter, span.enter);
    ASSERT_EQ(at_once.leave, span.leave);
    ASSERT_EQ(at_once.until, span.until);
    const double leave = kernels::leave_face(p.z - high, v.z, tolerance, infinity);
    ASSERT_EQ(kernels::leave_ends(low, high, p, v, tolerance),
              kernels::smaller(kernels::leave_face(low - p.z, -v.z, tolerance, leave), leave));
  }
}

TEST(Grazing, RoundFacesOfAllKindsAgreeOnWhatComesInDeeperThanTheTolerance) {
  // On the surface, nearly along the axis, down to some depth of the order of the tolerance.
  Random random(64);
  constexpr double tolerance = 1e-9, turn = 2 * std::numbers::pi;
  int in = 0, past = 0;
  for (int n = 0; n < scaled(20000); ++n) {
    const double r = random.scale(1, 1000);
    const std::vector<ZPlane> planes{{-1e4, 0, r}, {0, 0, r}, {1e4, 0, 2 * r}};
    const Solid solids[] = {make_tube("t", 0, r, 1e4, 0, turn), make_polycone("p", planes, 0, turn),
                            make_eltube("e", r, r, 1e4)};
    const double depth = tolerance * random.scale(0.01, 100);
    if (std::abs(depth - tolerance) < 0.01 * tolerance) continue;
    // A chord as deep as that, entered where it begins: across, at the slope of the chord.
    const double half = std::sqrt(depth * (2 * r - depth));
    const double across = random.scale(1e-5, 1), along = std::sqrt(1 - across * across);
    const double phi = random.uniform(0, turn), c = std::cos(phi), s = std::sin(phi);
    const double x = r - depth, vx = 0, vy = across;
    const V p{c * x + s * half, s * x - c * half, -1};
    const Direction v = kernels::make_direction(c * vx - s * vy, s * vx + c * vy, along);
    for (const Solid& solid : solids) {
      EXPECT_EQ(contains(solid.any(), p, v, tolerance), depth > tolerance)
          << solid.name << ", depth " << depth << ", radius " << r << ", across " << across;
    }
    ++(depth > tolerance ? in : past);
  }
  EXPECT_GT(in, scaled(20000) / 4);
  EXPECT_GT(past, scaled(20000) / 4);
}

}  // namespace
}  // namespace navjit::test
