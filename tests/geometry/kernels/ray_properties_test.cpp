// Every kernel against its oracle: where points are, how far rays go, how near the surface is.
#include <gtest/gtest.h>

#include "tests/geometry/kernels/random_curved_solids.hpp"
#include "tests/geometry/kernels/random_flat_solids.hpp"

namespace navjit::test {
namespace {

using kernels::Side;

constexpr double inf = std::numeric_limits<double>::infinity();

std::string describe(const SolidCase& c, const Vec3& p, const Direction& v) {
  char text[400];
  std::snprintf(text, sizeof text, "%s of size %g, p = (%a, %a, %a), v = (%a, %a, %a)",
                kind_name(c.solid.kind), c.size, p.x, p.y, p.z, v.x, v.y, v.z);
  return text;
}

class RayProperties : public testing::TestWithParam<Maker> {};

/// Checks everything that the kernel says about one ray from a point away from the surface.
void check_ray(const SolidCase& c, const Vec3& p, const Direction& v) {
  SCOPED_TRACE(describe(c, p, v));
  const kernels::AnySolid<double> s = c.solid.any();
  const double tol = c.tolerance();
  const Wide f = c.distance(along(p, v, 0));
  const double magnitude = c.size + std::hypot(p.x, p.y, p.z);
  if (std::abs(f) < 10 * tol) return;

  const bool in = f < 0;
  if (in) {
    // Searches by boxes rely on the extent.
    const Extent& e = c.solid.extent;
    ASSERT_TRUE(p.x >= e.min.x - tol && p.x <= e.max.x + tol && p.y >= e.min.y - tol &&
                p.y <= e.max.y + tol && p.z >= e.min.z - tol && p.z <= e.max.z + tol);
  }
  ASSERT_EQ(inside(s, p, tol), in ? Side::inside : Side::outside);
  ASSERT_EQ(contains(s, p, v, tol), in);
  const double near_in = safety_to_in(s, p), near_out = safety_to_out(s, p);
  ASSERT_GE(near_in, 0);
  ASSERT_GE(near_out, 0);
  ASSERT_EQ(in ? near_in : near_out, 0);

  const Wide resolution = 1e-7L * c.size;
  const auto crossing = first_crossing(c.distance, p, v, 0, 3 * magnitude, resolution);
  if (!crossing) return;
  if (in) {
    ASSERT_TRUE(std::isfinite(crossing->path));
  }
  const double t = in ? distance_to_out(s, p, v, tol) : distance_to_in(s, p, v, tol);
  ASSERT_LE(in ? near_out : near_in, crossing->path + 1e-12L * magnitude);
  if (in) {
    ASSERT_EQ(distance_to_in(s, p, v, tol), inf);
  }
  if (!std::isfinite(crossing->path)) {
    if (t < inf) {
      // A touch within the oracle's resolution.
      ASSERT_LT(std::abs(c.distance(along(p, v, t))), resolution);
    }
    return;
  }
  const Wide slope = std::max<Wide>(crossing->slope, 1e-12L);
  // Clipping an edge within the tolerance is nobody's crossing.
  if (slope < 1e-5L) return;
  const Wide bound = 1e-9L * crossing->path + (1e-13L * magnitude) / slope;
  if (std::abs(t - crossing->path) > bound) {
    const Wide after = c.distance(along(p, v, crossing->path + 20 * tol / slope));
    if (std::abs(after) > 5 * tol) {
      ASSERT_LE(std::abs(t - crossing->path), bound)
          << "got " << t << ", should be " << static_cast<double>(crossing->path);
    }
    return;
  }
  const Vec3 hit = kernels::advance(p, v, t);
  ASSERT_EQ(inside(s, hit, tol), Side::surface);
  const Wide beyond = c.distance(along(p, v, crossing->path + 100 * tol / slope));
  if (slope > 1e-3L && std::abs(beyond) > 10 * tol) {
    ASSERT_EQ(contains(s, hit, v, tol), !in);
  }
}

TEST_P(RayProperties, AgreeWithTheOracle) {
  Random random(11);
  for (int i = 0, n = scaled(150); i < n; ++i) {
    const SolidCase c = GetParam().make(random);
    for (int k = 0; k < 80; ++k) {
      Vec3 p = random.point_in(c.solid.extent, random.chance(0.5) ? 0.0 : 0.5);
      Direction v = random.any_direction();
      if (random.chance(0.2)) {
        // From far away, towards the solid.
        const Vec3 target = random.point_in(c.solid.extent, 0.1);
        const double far = c.size * random.scale(1, 1e4);
        p = {target.x - far * v.x, target.y - far * v.y, target.z - far * v.z};
      }
      check_ray(c, p, v);
      if (HasFatalFailure()) return;
    }
  }
}

/// A point within rounding of the surface, found by a random ray; nothing if the ray met none.
std::optional<Vec3> surface_point(const SolidCase& c, Random& random) {
  const Vec3 p = random.point_in(c.solid.extent, 0.2);
  const Direction v = random.direction();
  const auto crossing = first_crossing(c.distance, p, v, 0, 3 * c.size, 1e-7L * c.size);
  if (!crossing || !std::isfinite(crossing->path)) return std::nullopt;
  const WidePoint hit = along(p, v, crossing->path);
  return Vec3{static_cast<double>(hit.x), static_cast<double>(hit.y), static_cast<double>(hit.z)};
}

TEST_P(RayProperties, StartsOnTheSurfaceGoByTheDirection) {
  Random random(12);
  for (int i = 0, n = scaled(120); i < n; ++i) {
    const SolidCase c = GetParam().make(random);
    const kernels::AnySolid<double> s = c.solid.any();
    const double tol = c.tolerance();
    for (int k = 0; k < 40; ++k) {
      const auto p = surface_point(c, random);
      if (!p) continue;
      const Direction v = random.any_direction();
      SCOPED_TRACE(describe(c, *p, v));
      ASSERT_EQ(inside(s, *p, tol), Side::surface);
      ASSERT_LE(safety_to_in(s, *p), tol);
      ASSERT_LE(safety_to_out(s, *p), tol);
      // What comes next, unless an edge is near or the ray slides along the surface.
      const Wide step = 1e-5L * c.size;
      const Wide at_once = c.distance(along(*p, v, step / 100)) / (step / 100);
      const Wide soon = c.distance(along(*p, v, step)) / step;
      const Wide before = c.distance(along(*p, v, -step)) / step;
      if (std::abs(soon) < 1e-2L || std::abs(soon - at_once) > 1e-3L ||
          std::abs(soon + before) > 1e-2L) {
        continue;
      }
      const bool enters = soon < 0;
      ASSERT_EQ(contains(s, *p, v, tol), enters);
      const double in = distance_to_in(s, *p, v, tol), out = distance_to_out(s, *p, v, tol);
      ASSERT_EQ(enters ? in : out, 0);
      const auto next = first_crossing(c.distance, *p, v, step, 3 * c.size, 1e-7L * c.size);
      if (!next || next->slope < 1e-4L) continue;
      const double t = enters ? out : in;
      if (std::isfinite(next->path) || t == inf) {
        ASSERT_TRUE(std::abs(t - next->path) <= 1e-9L * c.size / next->slope ||
                    (t == inf && std::isinf(next->path)))
            << "got " << t << ", should be " << static_cast<double>(next->path);
      }
    }
  }
}

/// Checks what must hold for every start and direction, also on edges and tangents: the directional
/// answers agree with one another, so that a navigator cannot go round in circles.
void check_agreement(const SolidCase& c, const Vec3& p, const Direction& v) {
  SCOPED_TRACE(describe(c, p, v));
  const kernels::AnySolid<double> s = c.solid.any();
  const double tol = c.tolerance();
  const Side side = inside(s, p, tol);
  const bool in = contains(s, p, v, tol);
  if (side == Side::inside) {
    ASSERT_TRUE(in);
  }
  if (side == Side::outside) {
    ASSERT_FALSE(in);
  }
  const double to_in = distance_to_in(s, p, v, tol);
  ASSERT_GE(to_in, 0);
  if (in) {
    ASSERT_EQ(to_in, side == Side::surface ? 0 : inf);
    const double to_out = distance_to_out(s, p, v, tol);
    ASSERT_GT(to_out, 0);
    ASSERT_LT(to_out, 4 * c.size);
  } else {
    ASSERT_GT(to_in, 0);
    if (side == Side::surface) {
      ASSERT_EQ(distance_to_out(s, p, v, tol), 0);
    }
  }
}

TEST_P(RayProperties, DirectionalAnswersAgreeEverywhere) {
  Random random(13);
  for (int i = 0, n = scaled(150); i < n; ++i) {
    const SolidCase c = GetParam().make(random);
    const Extent& e = c.solid.extent;
    for (int k = 0; k < 100; ++k) {
      // On a lattice that hits faces, edges and axes.
      const auto lattice = [&](double low, double high) {
        switch (random.integer(0, 5)) {
          case 0:
            return low;
          case 1:
            return high;
          case 2:
            return 0.0;
          case 3:
            return (low + high) / 2;
          default:
            return random.uniform(low, high);
        }
      };
      Vec3 p{lattice(e.min.x, e.max.x), lattice(e.min.y, e.max.y), lattice(e.min.z, e.max.z)};
      if (random.chance(0.5)) {
        if (const auto on = surface_point(c, random)) p = *on;
      }
      if (random.chance(0.3)) {
        // Within the tolerance of whatever is here, or just beyond.
        const double off = c.tolerance() * random.uniform(-2, 2);
        const Direction u = random.any_direction();
        p = {p.x + off * u.x, p.y + off * u.y, p.z + off * u.z};
      }
      check_agreement(c, p, random.any_direction());
      if (HasFatalFailure()) return;
    }
  }
}

TEST_P(RayProperties, RaysTowardsAnInteriorPointAreNeverLost) {
  Random random(14);
  for (int i = 0, n = scaled(150); i < n; ++i) {
    const SolidCase c = GetParam().make(random);
    const kernels::AnySolid<double> s = c.solid.any();
    const double tol = c.tolerance();
    const Extent& e = c.solid.extent;
    for (int k = 0; k < 60; ++k) {
      const Vec3 q = random.point_in(e, 0);
      if (c.distance({q.x, q.y, q.z}) > -100 * tol) continue;
      // Through the surface, an edge of the extent, or the axis.
      Vec3 aim{random.chance(0.5) ? e.min.x : e.max.x, random.chance(0.5) ? e.min.y : e.max.y,
               random.chance(0.5) ? e.min.z : e.max.z};
      if (random.chance(0.3)) aim.x = aim.y = 0;
      if (random.chance(0.3)) {
        if (const auto on = surface_point(c, random)) aim = *on;
      }
      const double far = random.scale(1, 1e3);
      const Vec3 p{q.x + far * (aim.x - q.x), q.y + far * (aim.y - q.y), q.z + far * (aim.z - q.z)};
      const double dx = q.x - p.x, dy = q.y - p.y, dz = q.z - p.z, path = std::hypot(dx, dy, dz);
      if (c.distance({p.x, p.y, p.z}) < 10 * tol || !(path > 0)) continue;
      const Direction v = kernels::make_direction(dx / path, dy / path, dz / path);
      SCOPED_TRACE(describe(c, p, v));
      ASSERT_LT(distance_to_in(s, p, v, tol), path);
      // And on the way back.
      const Direction back = kernels::make_direction(-v.x, -v.y, -v.z);
      ASSERT_LT(distance_to_out(s, q, back, tol), path);
    }
  }
}

TEST_P(RayProperties, SteppingThroughAlternatesAndEnds) {
  Random random(15);
  for (int i = 0, n = scaled(100); i < n; ++i) {
    const SolidCase c = GetParam().make(random);
    const kernels::AnySolid<double> s = c.solid.any();
    const double tol = c.tolerance();
    for (int k = 0; k < 40; ++k) {
      const Vec3 target = random.point_in(c.solid.extent, 0);
      const Direction v = random.any_direction();
      const double far = c.size * random.scale(1, 1e4);
      Vec3 p{target.x - far * v.x, target.y - far * v.y, target.z - far * v.z};
      if (c.distance({p.x, p.y, p.z}) < 10 * tol) continue;
      SCOPED_TRACE(describe(c, p, v));
      int crossings = 0;
      for (bool in = false;; in = !in) {
        const double t = in ? distance_to_out(s, p, v, tol) : distance_to_in(s, p, v, tol);
        ASSERT_GE(t, 0);
        if (!in && !(t < inf)) break;
        ASSERT_LT(t, inf);
        p = kernels::advance(p, v, t);
        ASSERT_LT(++crossings, 200);
      }
      ASSERT_EQ(crossings % 2, 0);
      const Wide value = c.distance({target.x, target.y, target.z});
      if (value < -100 * tol) {
        ASSERT_GE(crossings, 2);
      }
    }
  }
}

std::string name_of(const testing::TestParamInfo<Maker>& test) { return test.param.name; }

INSTANTIATE_TEST_SUITE_P(Primitives, RayProperties, testing::ValuesIn(primitive_makers), name_of);
INSTANTIATE_TEST_SUITE_P(Curved, RayProperties, testing::ValuesIn(curved_makers), name_of);
INSTANTIATE_TEST_SUITE_P(Flat, RayProperties, testing::ValuesIn(flat_makers), name_of);
INSTANTIATE_TEST_SUITE_P(Composites, RayProperties, testing::ValuesIn(composite_makers), name_of);

}  // namespace
}  // namespace navjit::test
