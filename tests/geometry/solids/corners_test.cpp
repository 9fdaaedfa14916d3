// Solids from corners, facets and contours: what their makers accept and refuse, and their
// volumes.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "geometry/solids/solid.hpp"
#include "tests/geometry/solids/refusal.hpp"

namespace navjit {
namespace {

constexpr double pi = std::numbers::pi, turn = 2 * pi;
constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double tol = 1e-9;

using Polygon = std::vector<PlanarPoint>;
using Sections = std::vector<ExtrudedSection>;
using Contour = std::vector<ContourPoint>;
using Mesh = std::vector<FacetCorners>;

const Polygon square{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
const Polygon corner{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
const Sections prism{{-1, 0, 0, 1}, {1, 0, 0, 1}};
constexpr PlanarPoint upright[8] = {{-1, -1}, {-1, 1}, {1, 1}, {1, -1},
                                    {-1, -1}, {-1, 1}, {1, 1}, {1, -1}};

Side where(const Solid& s, double x, double y, double z) {
  return inside(s.any(), Vec3{x, y, z}, tol);
}
Direction towards(double x, double y, double z) {
  const double norm = std::hypot(x, y, z);
  return kernels::make_direction(x / norm, y / norm, z / norm);
}
/// A box made of quadrilaterals.
Mesh cube(double h) {
  const auto at = [h](int i) { return Vec3{i & 1 ? h : -h, i & 2 ? h : -h, i & 4 ? h : -h}; };
  constexpr int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                               {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  Mesh mesh;
  for (const auto& q : quads) mesh.push_back({at(q[0]), at(q[1]), at(q[2]), at(q[3])});
  return mesh;
}

TEST(Corners, VolumesAreThoseOfTextbooks) {
  EXPECT_DOUBLE_EQ(capacity(make_extruded("s", square, prism)), 8);
  EXPECT_DOUBLE_EQ(capacity(make_extruded("s", corner, prism)), 6);
  // A pyramid cut off at half its height.
  const Sections frustum{{0, 0, 0, 1}, {1, 5, 3, 0.5}};
  EXPECT_NEAR(capacity(make_extruded("s", square, frustum)), 4 * 7 / 12.0, 1e-13);
  EXPECT_NEAR(capacity(make_tet("s", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1})), 1 / 6.0, 1e-15);
  EXPECT_NEAR(capacity(make_para("s", 1, 2, 3, 0.3, 0.4, 0.5)), 48, 1e-12);
  EXPECT_NEAR(capacity(make_arb8("s", 3, upright)), 24, 1e-13);
  EXPECT_NEAR(capacity(make_tessellated("s", cube(1))), 8, 1e-14);
  EXPECT_NEAR(capacity(make_cut_tube("s", 1, 2, 3, 0, turn, {0.1, 0, -1}, {0, 0.2, 1})), 18 * pi,
              1e-12);
  const Contour ring{{1, 0}, {2, 0}, {2, 1}, {1, 1}};
  EXPECT_NEAR(capacity(make_generic_polycone("s", ring, 0, turn)), 3 * pi, 1e-13);
  const double r = std::sqrt(2.0);
  EXPECT_NEAR(
      capacity(make_generic_polyhedra("s", Contour{{0, 0}, {r, 0}, {r, 1}, {0, 1}}, 4, 0, turn)), 4,
      1e-13);
  EXPECT_NEAR(capacity(make_scaled("s", make_orb("o", 1), 1, -2, 3)), 8 * pi, 1e-13);
}

TEST(Corners, KindsAreTheSimplestThatServe) {
  EXPECT_EQ(make_extruded("s", square, prism).kind, SolidKind::hull);
  EXPECT_EQ(make_extruded("s", corner, prism).kind, SolidKind::prism);
  EXPECT_EQ(make_extruded("s", corner, Sections{{0, 0, 0, 1}, {1, 0, 0, 1}, {3, 0, 0, 1}}).kind,
            SolidKind::prism);
  EXPECT_EQ(make_extruded("s", corner, Sections{{0, 0, 0, 1}, {1, 1, 0, 1}}).kind,
            SolidKind::facets);
  EXPECT_EQ(make_extruded("s", corner, Sections{{0, 0, 0, 1}, {1, 0, 0, 2}}).kind,
            SolidKind::facets);
  EXPECT_EQ(make_arb8("s", 1, upright).kind, SolidKind::hull);
  PlanarPoint twisted[8];
  std::copy(std::begin(upright), std::end(upright), twisted);
  twisted[4].x = -2;
  EXPECT_EQ(make_arb8("s", 1, twisted).kind, SolidKind::arb8);
  EXPECT_STREQ(kind_name(SolidKind::hull), "hull");
  EXPECT_STREQ(kind_name(SolidKind::cut_tube), "cuttube");
}

/// A comb whose gaps end on one line, turned: rounding must not let edges there cross.
TEST(Corners, EdgesOnOneLineDoNotCross) {
  for (int step = 0; step < 200; ++step) {
    const double phi = 0.05 + 0.03 * step, c = std::cos(phi), s = std::sin(phi);
    std::vector<PlanarPoint> comb{{5, -1}};
    for (int tooth = 0; tooth < 5; ++tooth) {
      const double x = 5 - 2.1 * tooth;
      for (const auto& [dx, y] : {std::pair(0.0, 0.0), {-0.1, 1.3}, {-1.1, 1.3}, {-1.3, 0.0}}) {
        comb.push_back({x + dx, y});
      }
    }
    comb.push_back({-5, -1});
    for (PlanarPoint& p : comb) p = {c * p.x - s * p.y, s * p.x + c * p.y};
    std::string note;
    const Solid solid = make_extruded("comb", comb, Sections{{0, 0, 0, 1}, {1, 0, 0, 1}}, &note);
    EXPECT_EQ(solid.kind, SolidKind::prism) << step;
    EXPECT_EQ(note, "") << step;
  }
}

TEST(Corners, RefuseWhatMakesNoSolid) {
  EXPECT_EQ(refusal([] {
              make_extruded("s", Polygon{{0, 0}, {2, 2}, {2, 0}, {0, 2}}, prism);
            }).substr(0, 11),
            "solid 's': ");
  EXPECT_EQ(refusal([] {
              make_extruded("s", Polygon{{0, 0}, {4, 3}, {4, 0}, {0, 3}, {-2, 1}}, prism);
            }).substr(0, 37),
            "solid 's': its polygon crosses itself");
  EXPECT_THROW(make_extruded("s", Polygon{{0, 0}, {1, 1}, {2, 2}}, prism), GeometryError);
  EXPECT_THROW(make_extruded("s", square, Sections{{0, 0, 0, 1}}), GeometryError);
  EXPECT_THROW(make_extruded("s", square, Sections{{0, 0, 0, 1}, {0, 0, 0, 1}}), GeometryError);
  EXPECT_THROW(make_extruded("s", square, Sections{{0, 0, 0, 1}, {1, 0, 0, 0}}), GeometryError);
  EXPECT_THROW(make_tet("s", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}), GeometryError);
  EXPECT_THROW(make_arb8("s", 0, upright), GeometryError);
  PlanarPoint turned[8];
  std::copy(std::begin(upright), std::end(upright), turned);
  std::rotate(turned + 4, turned + 6, turned + 8);
  EXPECT_EQ(refusal([&] { make_arb8("s", 1, turned); }),
            "solid 's': a side of an arb8 twists by more than 90 degrees");
  EXPECT_THROW(make_tessellated("s", Mesh{}), GeometryError);
  EXPECT_THROW(make_cut_tube("s", 0, 1, 1, 0, turn, {0, 0, 1}, {0, 0, 1}), GeometryError);
  EXPECT_EQ(refusal([] {
              make_cut_tube("s", 0, 5, 1, 0, turn, {1, 0, -1}, {1, 0, 1});
            }),
            "solid 's': the ends of a cutTube meet within it");
  EXPECT_THROW(make_generic_polycone("s", Contour{{0, 0}, {1, 1}}, 0, turn), GeometryError);
  EXPECT_THROW(make_generic_polycone("s", Contour{{-1, 0}, {1, 1}, {2, 0}}, 0, turn),
               GeometryError);
  EXPECT_THROW(make_scaled("s", make_orb("o", 1), 1, 0, 1), GeometryError);
}

TEST(Corners, PolygonsMayRunEitherWayRoundAndRepeatThemselves) {
  const Polygon untidy{{-1, -1}, {-1, -1}, {-1, 0}, {-1, 1}, {1, 1}, {1, -1}, {0, -1}};
  const Solid s = make_extruded("s", untidy, prism);
  EXPECT_EQ(static_cast<const kernels::Hull<double>*>(s.shape.get())->count, 6);
  EXPECT_EQ(where(s, 0.9, 0.9, 0.9), Side::inside);
  Mesh inward = cube(1);
  for (FacetCorners& f : inward) std::reverse(f.begin(), f.end());
  EXPECT_EQ(where(make_tessellated("s", inward), 0, 0, 0), Side::inside);
}

TEST(Corners, ArbsMayTaperToAnEdgeOrAPoint) {
  const PlanarPoint roof[8] = {{-1, -1}, {-1, 1}, {1, 1}, {1, -1},
                               {-1, 0},  {-1, 0}, {1, 0}, {1, 0}};
  const Solid s = make_arb8("s", 1, roof);
  EXPECT_NEAR(capacity(s), 4, 1e-13);
  EXPECT_EQ(where(s, 0, 0.4, 0), Side::inside);
  EXPECT_EQ(where(s, 0, 0.6, 0), Side::outside);
  const PlanarPoint pyramid[8] = {{-1, -1}, {-1, 1}, {1, 1}, {1, -1},
                                  {0, 0},   {0, 0},  {0, 0}, {0, 0}};
  EXPECT_NEAR(capacity(make_arb8("s", 1, pyramid)), 8 / 3.0, 1e-13);
}

TEST(Facets, LoseNoRayThroughCornersAndEdges) {
  const Solid s = make_tessellated("s", cube(1));
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        // Through a corner, the middle of an edge, or the diagonal of a face, to the centre.
        const double norm = std::hypot(x, y, z);
        const Vec3 p{5.0 * x, 5.0 * y, 5.0 * z};
        const Direction v = towards(-x, -y, -z);
        EXPECT_NEAR(distance_to_in(s.any(), p, v, tol), 4 * norm, 1e-14 * 5 * norm);
        EXPECT_NEAR(distance_to_out(s.any(), Vec3{0, 0, 0}, towards(x, y, z), tol), norm, 1e-14);
        const Vec3 on{1.0 * x, 1.0 * y, 1.0 * z};
        EXPECT_TRUE(contains(s.any(), on, v, tol));
        EXPECT_EQ(distance_to_in(s.any(), on, v, tol), 0);
        EXPECT_NEAR(distance_to_out(s.any(), on, v, tol), 2 * norm, 1e-14);
        EXPECT_FALSE(contains(s.any(), on, towards(x, y, z), tol));
        EXPECT_EQ(distance_to_out(s.any(), on, towards(x, y, z), tol), 0);
      }
    }
  }
}

TEST(Facets, AreCrossedAsOftenAsThereAreTeeth) {
  // A comb of 30 teeth: more crossings than are kept at a time.
  Polygon comb{{0, 0}};
  for (int i = 0; i < 30; ++i) {
    for (const auto& [x, y] : {std::pair(0.0, 1.0), {0.5, 1.0}, {0.5, 0.1}, {1.0, 0.1}}) {
      comb.push_back({i + x, y});
    }
  }
  comb.back().y = 0;
  const Solid s = make_extruded("s", comb, prism);
  Vec3 p{-5, 0.5, 0.25};
  const Direction v = towards(1, 0, 0);
  for (int i = 0; i < 30; ++i) {
    const double in = distance_to_in(s.any(), p, v, tol);
    EXPECT_NEAR(p.x + in, i, 1e-12);
    p.x += in;
    EXPECT_NEAR(distance_to_out(s.any(), p, v, tol), 0.5, 1e-12);
    p.x += 0.5;
  }
  EXPECT_EQ(distance_to_in(s.any(), p, v, tol), inf);
  // Along the back, below all teeth.
  EXPECT_NEAR(distance_to_out(s.any(), Vec3{1, 0.05, 0}, v, tol), 28.55, 0.5);
}

TEST(Scaled, IsTheSolidInStretchedCoordinates) {
  const Solid s = make_scaled("s", make_box("b", 1, 2, 3), -2, 1, 0.5);
  EXPECT_NEAR(s.extent.max.x, 2, 1e-15);
  EXPECT_NEAR(s.extent.min.z, -1.5, 1e-15);
  EXPECT_EQ(where(s, 1.9, 1.9, 1.4), Side::inside);
  EXPECT_NEAR(distance_to_in(s.any(), Vec3{5, 0, 0}, towards(-1, 0, 0), tol), 3, 1e-15);
  EXPECT_NEAR(distance_to_out(s.any(), Vec3{0, 0, 0}, towards(1, 0, 1), tol), 1.5 * std::sqrt(2.0),
              1e-14);
  EXPECT_LE(safety_to_out(s.any(), Vec3{0, 0, 0}), 1.5);
}

}  // namespace
}  // namespace navjit
