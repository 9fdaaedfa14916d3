// Normals against those of the same kernels with 113 bits, and against the slopes of oracles that
// are independent of the kernels.
#include <gtest/gtest.h>

#include "geometry/solids/normal.hpp"
#include "geometry/solids/widen.hpp"
#include "tests/geometry/kernels/random_curved_solids.hpp"
#include "tests/geometry/kernels/random_flat_solids.hpp"

namespace navjit::test {
namespace {

__extension__ typedef __float128 Quad;

double apart(const Vec3& a, const Vec3& b) {
  return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) +
                   (a.z - b.z) * (a.z - b.z));
}
Vec3 moved(const Vec3& p, double by, const Vec3& along) {
  return {p.x + by * along.x, p.y + by * along.y, p.z + by * along.z};
}

/// The normal computed with 113 bits.
Vec3 wide_normal(const WideSolid<Quad>& wide, const Vec3& p, double tol) {
  const kernels::Vec3<Quad> n =
      kernels::normal<Quad>(wide.any(), kernels::Vec3<Quad>{p.x, p.y, p.z}, Quad(tol));
  return {static_cast<double>(n.x), static_cast<double>(n.y), static_cast<double>(n.z)};
}

/// The direction in which an oracle grows, from differences over `step`. Nothing where there is
/// none, or where it differs between the two sides, as at an edge.
std::optional<Vec3> slope(const SolidCase& c, const Vec3& p, double step) {
  bool edge = false;
  const auto along = [&](const Vec3& axis) {
    const auto at = [&](double by) {
      const Wide h = by;
      return c.distance({p.x + h * axis.x, p.y + h * axis.y, p.z + h * axis.z});
    };
    const Wide ahead = (at(step) - at(0)) / step, behind = (at(0) - at(-step)) / step;
    edge |= std::abs(ahead - behind) > 1e-3L;
    return static_cast<double>((ahead + behind) / 2);
  };
  const Vec3 g{along({1, 0, 0}), along({0, 1, 0}), along({0, 0, 1})};
  const double size = std::sqrt(dot(g, g));
  if (edge || !(size > 1e-3)) return std::nullopt;
  return Vec3{g.x / size, g.y / size, g.z / size};
}

/// The point where a random ray crosses the surface.
std::optional<Vec3> crossing(const SolidCase& c, Random& random) {
  const kernels::AnySolid<double> s = c.solid.any();
  const Vec3 p = random.point_in(c.solid.extent, 0.2);
  const Direction v = random.direction();
  const double tol = c.tolerance();
  const bool in = contains(s, p, v, tol);
  const double t = in ? distance_to_out(s, p, v, tol) : distance_to_in(s, p, v, tol);
  if (!(t < 10 * c.size)) return std::nullopt;
  return kernels::advance(p, v, t);
}

class Normals : public testing::TestWithParam<Maker> {};

TEST_P(Normals, AreThoseOfTheReferenceAndOfTheOracle) {
  Random random(61);
  int points = 0, by_edges = 0, compared = 0;
  double worst = 0;
  for (int i = 0, n = scaled(100); i < n; ++i) {
    const SolidCase c = GetParam().make(random);
    const WideSolid<Quad> wide = widen<Quad>(c.solid);
    const double tol = 4 * c.tolerance();
    for (int k = 0; k < 40; ++k) {
      const auto p = crossing(c, random);
      if (!p) continue;
      ++points;
      const Vec3 found = normal(c.solid.any(), *p, tol);
      SCOPED_TRACE(::testing::Message()
                   << kind_name(c.solid.kind) << " of size " << c.size << " at " << p->x << ' '
                   << p->y << ' ' << p->z << ": normal " << found.x << ' ' << found.y << ' '
                   << found.z);
      ASSERT_NEAR(dot(found, found), 1, 1e-14);

      const Vec3 exact = wide_normal(wide, *p, tol);
      if (apart(found, exact) <= 1e-11) {
        worst = std::max(worst, apart(found, exact));
      } else {
        // Only where another face is within the tolerance may rounding choose between them.
        ++by_edges;
        bool near = false;
        for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
          for (const double by : {-8 * tol, 8 * tol}) {
            near |= apart(found, wide_normal(wide, moved(*p, by, axis), tol)) < 1e-6;
          }
        }
        ASSERT_TRUE(near) << "the reference's " << exact.x << ' ' << exact.y << ' ' << exact.z;
      }

      // By the oracle, unless an edge is near.
      const auto expected = slope(c, *p, 1e-10 * c.size);
      if (!expected) continue;
      ++compared;
      ASSERT_LT(apart(*expected, found), 1e-6)
          << "the oracle's " << expected->x << ' ' << expected->y << ' ' << expected->z;
    }
  }
  EXPECT_GT(points, scaled(100) * 5);
  EXPECT_GT(compared, points * 0.99);
  EXPECT_LE(by_edges, 2 + points / 1000);
  RecordProperty("points", points);
  RecordProperty("compared_with_the_oracle", compared);
  RecordProperty("largest_error_1e18", static_cast<int>(worst * 1e18));
}

std::string name_of(const testing::TestParamInfo<Maker>& info) { return info.param.name; }
INSTANTIATE_TEST_SUITE_P(Primitives, Normals, testing::ValuesIn(primitive_makers), name_of);
INSTANTIATE_TEST_SUITE_P(Curved, Normals, testing::ValuesIn(curved_makers), name_of);
INSTANTIATE_TEST_SUITE_P(Flat, Normals, testing::ValuesIn(flat_makers), name_of);
INSTANTIATE_TEST_SUITE_P(Composites, Normals, testing::ValuesIn(composite_makers), name_of);

constexpr double turn = 2 * std::numbers::pi;

void expect_normal(const Solid& s, const Vec3& p, const Vec3& n) {
  const Vec3 found = normal(s.any(), p, 1e-9);
  EXPECT_NEAR(found.x, n.x, 1e-12) << s.name << ' ' << p.x << ' ' << p.y << ' ' << p.z;
  EXPECT_NEAR(found.y, n.y, 1e-12) << s.name;
  EXPECT_NEAR(found.z, n.z, 1e-12) << s.name;
}

TEST(NormalsAtEdges, AreThoseOfTheFirstFaceWhateverIsRounded) {
  const Solid box = make_box("box", 1, 2, 3);
  const Solid tube = make_tube("tube", 1, 2, 3, 0, turn);
  for (const double off : {-1e-12, 0.0, 1e-12}) {
    expect_normal(box, {1 + off, 2, 3 - off}, {1, 0, 0});
    expect_normal(box, {0.5, -2 - off, 3 + off}, {0, -1, 0});
    expect_normal(tube, {2 + off, 0, 3}, {0, 0, 1});
    expect_normal(tube, {0, 1 - off, -3}, {0, 0, -1});
    expect_normal(tube, {0, 1 - off, 2.9}, {0, -1, 0});
  }
  // Beyond the tolerance the nearer face counts.
  expect_normal(box, {1 - 1e-6, 2, 0}, {0, 1, 0});
}

TEST(NormalsAtEdges, WhereAFaceHasNoneAreStillOfUnitLength) {
  for (const Solid& s : {make_orb("orb", 1), make_cone("cone", 0, 1, 0, 0, 1, 0, turn),
                         make_torus("torus", 0, 2, 2, 0, turn), make_elcone("elcone", 1, 1, 1, 1),
                         make_sphere("sphere", 0, 1, 0, 1, 0, 1)}) {
    for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{0, 0, 1}, Vec3{5e-324, 0, 1}, Vec3{0, 0, -1}}) {
      const Vec3 n = normal(s.any(), p, 1e-9);
      EXPECT_NEAR(dot(n, n), 1, 1e-14) << s.name;
    }
  }
}

TEST(NormalsOfBooleans, AreThoseOfTheOperandTurnedWhereItIsTakenAway) {
  const Solid box = make_box("box", 1, 1, 1), ball = make_orb("ball", 1.2);
  expect_normal(make_subtraction("less", box, ball), {1, 0.9, 0.9}, {1, 0, 0});
  const double third = std::sqrt(1.0 / 3), h = std::sqrt(0.5);
  expect_normal(make_subtraction("less", box, ball), {1.2 * third, 1.2 * third, 1.2 * third},
                {-third, -third, -third});
  expect_normal(make_intersection("both", box, ball), {1.2 * h, 0, 1.2 * h}, {h, 0, h});
  expect_normal(make_union("any", box, ball), {0, 0, 1.2}, {0, 0, 1});
  expect_normal(make_union("any", box, ball), {1, 0.9, 0.9}, {1, 0, 0});
  // Two boxes side by side: at the rim of the face between them, the outer faces count.
  const SolidFrame beside{.translation = {2, 0, 0}};
  const Solid pair = make_union("pair", box, make_placed("other", box, beside));
  expect_normal(pair, {1, 1, 0}, {0, 1, 0});
  expect_normal(pair, {1 - 1e-12, -1, 0.5}, {0, -1, 0});
  // A hole through to the other side: at its mouth, the face that it is cut into.
  const Solid bored = make_subtraction("bored", box, make_tube("hole", 0, 0.5, 1, 0, turn));
  expect_normal(bored, {0.5, 0, 1}, {0, 0, 1});
  expect_normal(bored, {0.5, 0, 0.5}, {-1, 0, 0});
  // Nested, turned and mirrored.
  SolidFrame quarter;
  quarter.rotation[0] = quarter.rotation[4] = 0;
  quarter.rotation[1] = 1;
  quarter.rotation[3] = -1;
  const Solid mirrored = make_scaled("mirrored", make_placed("turned", bored, quarter), -2, 1, 1);
  expect_normal(mirrored, {-1, 0, 0.5}, {1, 0, 0});
  expect_normal(mirrored, {-2, 0.9, 0.2}, {-1, 0, 0});
}

}  // namespace
}  // namespace navjit::test
