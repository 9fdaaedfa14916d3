// What the makers accept and refuse, and the conventions of their dimensions.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "geometry/solids/fields.hpp"
#include "geometry/solids/solid.hpp"
#include "tests/geometry/kernels/random.hpp"
#include "tests/geometry/solids/refusal.hpp"

namespace navjit {
namespace {

constexpr double pi = std::numbers::pi, turn = 2 * pi;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

using Planes = std::vector<ZPlane>;

Side where(const Solid& s, double x, double y, double z) {
  return inside(s.any(), Vec3{x, y, z}, 1e-9);
}

TEST(Factories, RefuseDimensionsThatMakeNoSolid) {
  EXPECT_EQ(refusal([] { make_box("b", 1, 0, 1); }), "solid 'b': a box needs positive lengths");
  EXPECT_THROW(make_box("s", 1, nan, 1), GeometryError);
  EXPECT_THROW(make_tube("s", 2, 1, 1, 0, turn), GeometryError);
  EXPECT_THROW(make_tube("s", 0, 1, 1, 0, 0), GeometryError);
  EXPECT_THROW(make_tube("s", 0, 1, 1, inf, 1), GeometryError);
  EXPECT_THROW(make_cone("s", 1, 1, 2, 2, 1, 0, turn), GeometryError);
  EXPECT_THROW(make_cone("s", -1, 1, 0, 2, 1, 0, turn), GeometryError);
  EXPECT_THROW(make_cone("s", 0, 1, 3, 2, 1, 0, turn), GeometryError);
  EXPECT_THROW(make_cone("s", 0, 1, 0, 2, 0, 0, turn), GeometryError);
  EXPECT_THROW(make_trd("s", 0, 0, 1, 1, 1), GeometryError);
  EXPECT_THROW(make_trd("s", 1, -1, 1, 1, 1), GeometryError);
  EXPECT_THROW(make_trap("s", 1, 0, 0, 1, 1, 1, 0, 1, 1, 0, 0), GeometryError);
  EXPECT_THROW(make_trap("s", 1, pi / 2, 0, 1, 1, 1, 0, 1, 1, 1, 0), GeometryError);
  EXPECT_THROW(make_orb("s", 0), GeometryError);
  EXPECT_THROW(make_sphere("s", 1, 1, 0, turn, 0, pi), GeometryError);
  EXPECT_THROW(make_sphere("s", 0, 1, 0, turn, -0.1, pi), GeometryError);
  EXPECT_THROW(make_sphere("s", 0, 1, 0, turn, 0, 0), GeometryError);
  EXPECT_THROW(make_polycone("s", Planes{{0, 0, 1}}, 0, turn), GeometryError);
  EXPECT_THROW(make_polycone("s", Planes{{0, 2, 1}, {1, 0, 1}}, 0, turn), GeometryError);
  EXPECT_THROW(make_polycone("s", Planes{{0, 1, 1}, {1, 2, 2}}, 0, turn), GeometryError);
  EXPECT_THROW(make_polycone("s", Planes{{0, 0, 1}, {0, 0, 2}}, 0, turn), GeometryError);
  EXPECT_THROW(make_polycone("s", Planes{{0, 0, nan}, {1, 0, 2}}, 0, turn), GeometryError);
  EXPECT_THROW(make_polyhedra("s", Planes{{0, 0, 1}, {1, 0, 2}}, 2, 0, turn), GeometryError);
  EXPECT_THROW(make_polyhedra("s", Planes{{0, 0, 1}, {1, 0, 2}}, 0, 0, 1), GeometryError);
}

TEST(Factories, JoinTheCornersOfTrapsThatAreNotPlanar) {
  const Solid bent = make_trap("t", 1, 0, 0, 1, 1, 1, 0, 1, 1, 3, 0);
  EXPECT_EQ(bent.kind, SolidKind::arb8);
  // Half way up the edge at y = -1 is at x = 1, that at y = 1 at x = 2.
  EXPECT_EQ(inside(bent.any(), Vec3{1.5, 0, 0}, 1e-9), Side::surface);
  EXPECT_EQ(inside(bent.any(), Vec3{1.75, 0.5, 0}, 1e-9), Side::surface);
  EXPECT_EQ(make_trap("t", 1, 0, 0, 1, 1, 1, 0, 1, 3, 3, 0).kind, SolidKind::trap);
}

TEST(Factories, SayWhatIsWrong) {
  EXPECT_EQ(refusal([] { make_trap("t", 1, 0, 0, 1, 1, 1, 0, 1, -1, 3, 1.4); }),
            "solid 't': a trap needs positive lengths");
  EXPECT_EQ(refusal([] {
              make_polycone("p", Planes{{0, 0, 1}, {1, 0, 1}, {1, 2, 3}, {2, 2, 3}}, 0, turn);
            }),
            "solid 'p': the parts on the two sides of a step do not touch");
  EXPECT_EQ(refusal([] {
              make_polycone("p", Planes{{0, 0, 1}, {2, 0, 1}, {1, 0, 0.5}, {1.5, 0, 2}}, 0, turn);
            }),
            "solid 'p': the contour crosses itself");
}

TEST(Factories, AcceptShapesThatTaperToNothing) {
  EXPECT_EQ(where(make_cone("s", 0, 2, 0, 0, 1, 0, turn), 0, 0, 0.999), Side::inside);
  EXPECT_EQ(where(make_cone("s", 0, 2, 2, 2, 1, 0, turn), 1.99, 0, 0.97), Side::inside);
  EXPECT_EQ(where(make_trd("s", 2, 0, 1, 0, 1), 0, 0, 1), Side::surface);
  EXPECT_EQ(where(make_trd("s", 0, 2, 1, 1, 1), 0.4, 0, -0.5), Side::inside);
  EXPECT_EQ(where(make_polycone("s", Planes{{0, 1, 1}, {1, 0, 2}}, 0, turn), 1, 0, 0.1),
            Side::inside);
}

TEST(Factories, TakeSpheresApartByPolarAngle) {
  EXPECT_EQ(make_sphere("s", 0, 1, 0.3, turn, 0, pi).kind, SolidKind::orb);
  EXPECT_EQ(make_sphere("s", 0, 1, 0, 7, 0, 4).kind, SolidKind::orb);
  const Solid upper = make_sphere("s", 0, 1, 0, turn, 0, pi / 2);
  EXPECT_EQ(where(upper, 0.5, 0, 0.1), Side::inside);
  EXPECT_EQ(where(upper, 0.5, 0, 0), Side::surface);
  EXPECT_EQ(where(upper, 0.5, 0, -0.1), Side::outside);
  EXPECT_EQ(upper.extent.min.z, 0);
  const Solid band = make_sphere("s", 0, 1, 0, turn, pi / 4, pi / 2);
  EXPECT_EQ(where(band, 0.1, 0, 0.5), Side::outside);
  EXPECT_EQ(where(band, 0.5, 0, 0.3), Side::inside);
  EXPECT_EQ(where(band, 0.1, 0, -0.5), Side::outside);
  EXPECT_NEAR(band.extent.max.z, std::sqrt(0.5), 1e-15);
}

TEST(Factories, DropRedundantPlanesOfAPolycone) {
  const Solid s = make_polycone(
      "s", Planes{{0, 0, 1}, {0, 0, 1}, {1, 0, 1}, {1, 0, 1.5}, {1, 0, 2}, {2, 0, 2}}, 0, turn);
  const auto& shape = *static_cast<const kernels::Polycone<double>*>(s.shape.get());
  EXPECT_EQ(shape.count, 2);
  EXPECT_EQ(where(s, 0.5, 0, 1), Side::inside);   // a seam within the solid
  EXPECT_EQ(where(s, 1.6, 0, 1), Side::surface);  // a step
  EXPECT_EQ(where(s, 1.6, 0, 0.9), Side::outside);
  EXPECT_NEAR(safety_to_out(s.any(), Vec3{0.5, 0, 1}), 0.5, 1e-15);
}

TEST(Factories, MeasurePolyhedraAcrossTheirSides) {
  // Four sides over a full turn from -45 degrees: a square prism with sides across x and y.
  const Solid s = make_polyhedra("s", Planes{{-1, 0, 2}, {1, 0, 2}}, 4, -pi / 4, turn);
  EXPECT_EQ(where(s, 2, 1.5, 0), Side::surface);
  EXPECT_EQ(where(s, 1.9, 1.9, 0), Side::inside);
  EXPECT_NEAR(s.extent.max.x, 2, 1e-15);
  EXPECT_NEAR(s.extent.min.y, -2, 1e-15);
  // Two sides over half a turn: edges at 0, 90 and 180 degrees.
  const Solid half = make_polyhedra("s", Planes{{-1, 0, 1}, {1, 0, 1}}, 2, 0, pi);
  EXPECT_EQ(where(half, 0, std::sqrt(2.0), 0), Side::surface);
  EXPECT_EQ(where(half, 0.1, std::sqrt(2.0), 0), Side::outside);
  EXPECT_EQ(where(half, 1, 0, 0), Side::surface);
}

/// A convex section is planes; cut in two by a plane across z it is a polyhedra still.
TEST(Factories, MakePlanesOfAConvexPolyhedra) {
  test::Random random(71);
  int met = 0;
  for (int n = 0; n < 200; ++n) {
    const int sides = random.integer(3, 12);
    const bool whole = random.chance(0.5);
    const double start = random.uniform(0, 6), delta = whole ? turn : random.uniform(0.5, 3.1);
    const double low = random.uniform(0.5, 2), high = random.chance(0.5) ? low : 1.5;
    const Solid solid =
        make_polyhedra("s", Planes{{-1, 0, low}, {1, 0, high}}, sides, start, delta);
    const Solid cut = make_polyhedra(
        "s", Planes{{-1, 0, low}, {0, 0, (low + high) / 2}, {1, 0, high}}, sides, start, delta);
    ASSERT_EQ(solid.kind, SolidKind::hull);
    ASSERT_EQ(cut.kind, SolidKind::polyhedra);
    EXPECT_EQ(solid.extent.max.x, cut.extent.max.x);
    EXPECT_NEAR(capacity(solid), capacity(cut), 1e-12);
    for (int ray = 0; ray < 50; ++ray) {
      const Vec3 p{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-1.5, 1.5)};
      const Direction v = random.any_direction();
      if (inside(cut.any(), p, 1e-9) == Side::surface) continue;
      ASSERT_EQ(contains(solid.any(), p, v, 1e-9), contains(cut.any(), p, v, 1e-9));
      if (contains(cut.any(), p, v, 1e-9)) {
        ASSERT_NEAR(distance_to_out(solid.any(), p, v, 1e-9),
                    distance_to_out(cut.any(), p, v, 1e-9), 1e-12);
        continue;
      }
      const double in = distance_to_in(cut.any(), p, v, 1e-9);
      if (in < 100) {
        ASSERT_NEAR(distance_to_in(solid.any(), p, v, 1e-9), in, 1e-10);
        ++met;
      }
    }
  }
  EXPECT_GT(met, 300);
  // What is bored, has a notch, or has very many sides is none.
  EXPECT_EQ(make_polyhedra("s", Planes{{-1, 1, 2}, {1, 0, 2}}, 6, 0, turn).kind,
            SolidKind::polyhedra);
  EXPECT_EQ(make_polyhedra("s", Planes{{-1, 0, 2}, {1, 0, 2}}, 6, 0, 4).kind, SolidKind::polyhedra);
  EXPECT_EQ(make_polyhedra("s", Planes{{-1, 0, 2}, {1, 0, 2}}, 15, 0, turn).kind,
            SolidKind::polyhedra);
}

TEST(Factories, PutTheCornersOfATrapWhereTheyBelong) {
  // The upper face is moved by theta and phi; alpha slants both.
  const double theta = 0.3, phi = 0.7, alpha = 0.2;
  const Solid s = make_trap("s", 5, theta, phi, 2, 1, 1.5, alpha, 4, 2, 3, alpha);
  const double x = 5 * std::tan(theta) * std::cos(phi), y = 5 * std::tan(theta) * std::sin(phi);
  EXPECT_EQ(where(s, -x - 2 * std::tan(alpha) - 1, -y - 2, -5), Side::surface);
  EXPECT_EQ(where(s, -x + 2 * std::tan(alpha) + 1.5, -y + 2, -5), Side::surface);
  EXPECT_EQ(where(s, x - 4 * std::tan(alpha) + 2, y - 4, 5), Side::surface);
  EXPECT_EQ(where(s, x + 4 * std::tan(alpha) - 3, y + 4, 5), Side::surface);
  EXPECT_EQ(where(s, x + 4 * std::tan(alpha) - 3.01, y + 4, 5), Side::outside);
}

TEST(Factories, KeepRightAnglesExact) {
  for (int quarter = -8; quarter < 8; ++quarter) {
    const Solid s = make_tube("s", 1, 2, 1, quarter * pi / 2, pi / 2);
    const auto& w = static_cast<const kernels::Tube<double>*>(s.shape.get())->wedge;
    EXPECT_EQ(w.kind, 1);
    EXPECT_EQ(std::abs(w.start_x) + std::abs(w.start_y), 1);
    EXPECT_EQ(w.start_x * w.end_x + w.start_y * w.end_y, 0);
    EXPECT_EQ(w.start_x * w.end_y - w.start_y * w.end_x, 1);
  }
}

TEST(Factories, OutliveTheirOperands) {
  Solid s = [] {
    const Solid pcone = make_polycone("p", Planes{{0, 0, 1}, {1, 0, 2}}, 0, turn);
    return make_subtraction("s", make_placed("m", pcone, {{0, 0, 1}}), make_box("b", 1, 1, 1));
  }();
  EXPECT_EQ(where(s, 1.1, 0, 1.5), Side::inside);
  EXPECT_EQ(where(s, 0.1, 0, 0.5), Side::outside);
}

struct FieldCounter {
  int numbers = 0, arrays = 0;
  void operator()(double) { ++numbers; }
  void operator()(int) { ++numbers; }
  template <class Struct>
  void operator()(const Struct& fields) {
    visit_fields(fields, *this);
  }
  template <class Element>
  void operator()(const Element* elements, int count) {
    ++arrays;
    for (int i = 0; i < count; ++i) visit_fields(elements[i], *this);
  }
};

TEST(SimplerSolids, AreMadeAsSuch) {
  const Solid tube = make_cone("s", 1, 2, 1, 2, 3, 0.5, 2);
  EXPECT_EQ(tube.kind, SolidKind::tube);
  EXPECT_EQ(tube.name, "s");
  const auto& t = *static_cast<const kernels::Tube<double>*>(tube.shape.get());
  EXPECT_EQ(t.rmin, 1);
  EXPECT_EQ(t.rmax, 2);
  EXPECT_EQ(t.hz, 3);
  EXPECT_EQ(t.wedge.kind, 1);
  EXPECT_EQ(make_trd("s", 1, 1, 2, 2, 3).kind, SolidKind::box);
  EXPECT_EQ(make_polycone("s", Planes{{-3, 1, 2}, {3, 1, 2}}, 0, 7).kind, SolidKind::tube);
  // From above to below, too.
  const Solid cone = make_polycone("s", Planes{{3, 0, 1}, {-3, 0, 2}}, 0, 7);
  EXPECT_EQ(cone.kind, SolidKind::cone);
  const Direction up = kernels::make_direction(0.0, 0.0, 1.0);
  EXPECT_TRUE(kernels::contains(cone.any(), Vec3{1.9, 0, -2.9}, up, 1e-9));
  EXPECT_FALSE(kernels::contains(cone.any(), Vec3{1.9, 0, 2.9}, up, 1e-9));
}

TEST(SimplerSolids, AreNotMadeOfWhatIsAnother) {
  EXPECT_EQ(make_cone("s", 1, 2, 1, 2.5, 3, 0, 7).kind, SolidKind::cone);
  EXPECT_EQ(make_cone("s", 0.5, 2, 1, 2, 3, 0, 7).kind, SolidKind::cone);
  EXPECT_EQ(make_trd("s", 1, 1, 2, 3, 3).kind, SolidKind::trd);
  EXPECT_EQ(make_polycone("s", Planes{{-3, 1, 2}, {4, 1, 2}}, 0, 7).kind, SolidKind::polycone);
  EXPECT_EQ(make_polycone("s", Planes{{-3, 1, 2}, {0, 1, 2}, {3, 1, 2}}, 0, 7).kind,
            SolidKind::polycone);
}

TEST(Fields, AreAllNumbersOfAShape) {
  const Solid s = make_polyhedra("s", Planes{{-1, 0, 2}, {1, 0.5, 2}}, 5, 0, 3);
  FieldCounter visitor;
  visit_fields(*static_cast<const kernels::Polyhedra<double>*>(s.shape.get()), visitor);
  EXPECT_EQ(visitor.arrays, 4);
  // A section of 9, 2 ledges of 3, 4 counts, 3 lengths, a wedge of 5, 5 normals of 2, once more by
  // eight.
  EXPECT_EQ(visitor.numbers, 9 + 2 * 3 + 4 + 3 + 5 + 5 * 2 + 8 * 2);
}

TEST(Factories, RefuseEmptyOperands) {
  const Solid none, ball = make_orb("ball", 1);
  EXPECT_THROW(make_union("s", none, ball), GeometryError);
  EXPECT_THROW(make_union("s", ball, none), GeometryError);
  EXPECT_THROW(make_intersection("s", none, ball), GeometryError);
  EXPECT_THROW(make_intersection("s", ball, none), GeometryError);
  EXPECT_THROW(make_subtraction("s", none, ball), GeometryError);
  EXPECT_THROW(make_subtraction("s", ball, none), GeometryError);
  EXPECT_THROW(make_placed("s", none, {}), GeometryError);
  EXPECT_THROW(make_scaled("s", none, 1, 2, 3), GeometryError);
  EXPECT_THROW(capacity(none), GeometryError);
}

TEST(Factories, RefuseFramesThatAreNoRotation) {
  const Solid ball = make_orb("ball", 1);
  SolidFrame stretched;
  stretched.rotation[0] = 5;
  EXPECT_THROW(make_placed("s", ball, stretched), GeometryError);
  SolidFrame far;
  far.translation[2] = INFINITY;
  EXPECT_THROW(make_placed("s", ball, far), GeometryError);
  try {
    make_placed("moved", ball, stretched);
  } catch (const GeometryError& error) {
    EXPECT_STREQ(error.what(), "solid 'moved': a rotation is not orthonormal");
  }
}

}  // namespace
}  // namespace navjit
