// The kernels in double against the same kernels with 113 bits: the effect of rounding.
#include <gtest/gtest.h>

#include <string_view>

#include "geometry/solids/widen.hpp"
#include "tests/geometry/kernels/random_curved_solids.hpp"
#include "tests/geometry/kernels/random_flat_solids.hpp"

namespace navjit::test {
namespace {

__extension__ typedef __float128 Quad;

class Precision : public testing::TestWithParam<Maker> {};

kernels::Vec3<Quad> quad(const Vec3& p) { return {p.x, p.y, p.z}; }
kernels::Direction<Quad> quad(const Direction& v) {
  return kernels::make_direction<Quad>(v.x, v.y, v.z);
}

/// |n.v| where a ray crosses the surface after `t`, from the growth of the safety beyond it.
double crossing_slope(const kernels::AnySolid<Quad>& s, const Vec3& p, const Direction& v, Quad t,
                      double size) {
  const Quad h = Quad(1e-9) * size;
  double slope = 0;
  for (const Quad step : {t - h, t + h}) {
    const kernels::Vec3<Quad> q = kernels::advance(quad(p), quad(v), step);
    const Quad near = safety_to_in(s, q) + safety_to_out(s, q);
    slope = std::max(slope, static_cast<double>(near / h));
  }
  return std::min(slope, 1.0);
}

TEST_P(Precision, DistancesAreWithinRoundingOfTheReference) {
  Random random(31);
  constexpr double inf = std::numeric_limits<double>::infinity();
  int compared = 0;
  for (int i = 0, n = scaled(100); i < n; ++i) {
    const SolidCase c = GetParam().make(random);
    const kernels::AnySolid<double> s = c.solid.any();
    const WideSolid<Quad> wide = widen<Quad>(c.solid);
    const double tol = c.tolerance();
    for (int k = 0; k < 60; ++k) {
      const Direction v = random.any_direction();
      Vec3 p = random.point_in(c.solid.extent, 0.3);
      if (random.chance(0.4)) {
        const double far = c.size * random.scale(1, 1e4);
        p = {p.x - far * v.x, p.y - far * v.y, p.z - far * v.z};
      }
      if (std::abs(c.distance({p.x, p.y, p.z})) < 10 * tol) continue;
      const bool in = contains(s, p, v, tol);
      ASSERT_EQ(in, contains(wide.any(), quad(p), quad(v), Quad(tol)));
      const double t = in ? distance_to_out(s, p, v, tol) : distance_to_in(s, p, v, tol);
      const Quad exact = in ? distance_to_out(wide.any(), quad(p), quad(v), Quad(tol))
                            : distance_to_in(wide.any(), quad(p), quad(v), Quad(tol));
      const bool hit = t < inf, exact_hit = exact < Quad(inf);
      if (!hit && !exact_hit) continue;
      const Quad first = !hit ? exact : (!exact_hit || exact < Quad(t)) ? exact : Quad(t);
      const double slope = crossing_slope(wide.any(), p, v, first, c.size);
      if (slope < 1e-4) continue;  // grazing: which face is hit may hang on the last bit
      const double magnitude = c.size + std::hypot(p.x, p.y, p.z);
      const double error = static_cast<double>(kernels::absolute(Quad(t) - exact));
      const double bound = 64 * std::numeric_limits<double>::epsilon() * magnitude / slope;
      if (error <= bound) {
        ++compared;
        continue;
      }
      // Only a ray within rounding of an edge may differ.
      const kernels::Vec3<Quad> q =
          kernels::advance(quad(p), quad(v), first + Quad(50 * tol / slope));
      const double beyond =
          static_cast<double>(safety_to_in(wide.any(), q) + safety_to_out(wide.any(), q));
      ASSERT_LE(beyond, 10 * tol) << kind_name(c.solid.kind) << " of size " << c.size << ": " << t
                                  << " is off by " << error << " at a slope of " << slope;
    }
  }
  EXPECT_GT(compared, 1000);
}

TEST_P(Precision, SafetiesAreWithinRoundingOfTheReference) {
  Random random(32);
  for (int i = 0, n = scaled(100); i < n; ++i) {
    const SolidCase c = GetParam().make(random);
    const WideSolid<Quad> wide = widen<Quad>(c.solid);
    for (int k = 0; k < 60; ++k) {
      const Vec3 p = random.point_in(c.solid.extent, random.scale(0.1, 1e3));
      const double bound =
          16 * std::numeric_limits<double>::epsilon() * (c.size + std::hypot(p.x, p.y, p.z));
      const Quad in = safety_to_in(wide.any(), quad(p)), out = safety_to_out(wide.any(), quad(p));
      // The reference of a boolean has no boxes around its operands, which only add to this
      // (OperandBoxes.AreInSafeties).
      const double ours = safety_to_in(c.solid.any(), p);
      ASSERT_GE(ours, static_cast<double>(in) - bound);
      if (std::string_view(GetParam().name) != "boolean") {
        ASSERT_LE(ours, static_cast<double>(in) + bound);
      }
      ASSERT_NEAR(safety_to_out(c.solid.any(), p), static_cast<double>(out), bound);
    }
  }
}

std::string name_of(const testing::TestParamInfo<Maker>& test) { return test.param.name; }

INSTANTIATE_TEST_SUITE_P(Primitives, Precision, testing::ValuesIn(primitive_makers), name_of);
INSTANTIATE_TEST_SUITE_P(Curved, Precision, testing::ValuesIn(curved_makers), name_of);
INSTANTIATE_TEST_SUITE_P(Flat, Precision, testing::ValuesIn(flat_makers), name_of);
INSTANTIATE_TEST_SUITE_P(Composites, Precision, testing::ValuesIn(composite_makers), name_of);

}  // namespace
}  // namespace navjit::test
