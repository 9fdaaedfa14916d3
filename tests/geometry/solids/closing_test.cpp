// Triangles that do not close on one another, and polygons that touch or cross themselves.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "geometry/model/random.hpp"
#include "navjit/vector.hpp"
#include "tests/support/meshes.hpp"

namespace navjit {
namespace {

using tests::ball;
using tests::block;
using tests::comb;
using tests::flip;
using tests::Mesh;

constexpr double tol = 1e-11;
/// Checks a ray through the whole solid: where it enters and leaves. Fails if it is stuck, or if
/// what the solid says about a place depends on the direction in which it was reached.
void expect_navigable(const Solid& s, const Vec3& start, const Vec3& v, std::mt19937_64& random) {
  const Direction d = kernels::make_direction(v.x, v.y, v.z);
  double path = 0;
  for (int turn = 0;; ++turn) {
    ASSERT_LT(turn, 200) << "stuck";
    const double in = distance_to_in(s.any(), start + path * v, d, tol);
    if (!(in < 1e9)) return;
    path += in;
    const double out = distance_to_out(s.any(), start + path * v, d, tol);
    ASSERT_LT(out, 100) << "lost";
    if (out > 1e-6) {
      const Vec3 middle = start + (path + out / 2) * v;
      if (inside(s.any(), middle, 1e-9) != Side::surface) {
        for (int k = 0; k < 3; ++k) {
          const Vec3 w = unit_vector(random);
          ASSERT_TRUE(contains(s.any(), middle, kernels::make_direction(w.x, w.y, w.z), tol));
        }
        ASSERT_GT(safety_to_out(s.any(), middle), 0);
        ASSERT_LE(safety_to_out(s.any(), middle), out / 2 + 1e-9);
      }
    }
    path += out;
  }
}
void expect_navigable(const Solid& s, int rays = 2000) {
  std::mt19937_64 random(5);
  for (int i = 0; i < rays && !::testing::Test::HasFatalFailure(); ++i) {
    const Vec3 v = unit_vector(random), at = 12 * uniform(random, 0, 1) * unit_vector(random);
    expect_navigable(s, at + (-40.0) * v, v, random);
  }
  // Along edges and through corners.
  const Mesh whole = ball();
  for (int i = 0; i < rays / 4 && !::testing::Test::HasFatalFailure(); ++i) {
    const FacetCorners& f = whole[random() % whole.size()];
    Vec3 v = random() % 2 == 0 ? f[1] - f[0] : unit_vector(random);
    v = (1 / norm(v)) * v;
    expect_navigable(s, f[0] + (-40.0) * v, v, random);
  }
}

/// Compares the answers with those of another solid, at random points and along random rays.
void expect_same(const Solid& s, const Solid& whole) {
  std::mt19937_64 random(6);
  int wrong = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 p{uniform(random, -12, 12), uniform(random, -12, 12), uniform(random, -12, 12)};
    const Vec3 v = unit_vector(random);
    const Direction d = kernels::make_direction(v.x, v.y, v.z);
    wrong += inside(s.any(), p, tol) != inside(whole.any(), p, tol) ? 1 : 0;
    const auto differ = [](double a, double b) {
      return !(a == b || std::abs(a - b) <= 1e-9 * std::max(a, b));
    };
    wrong += differ(distance_to_in(s.any(), p, d, tol), distance_to_in(whole.any(), p, d, tol));
    wrong += differ(distance_to_out(s.any(), p, d, tol), distance_to_out(whole.any(), p, d, tol));
  }
  EXPECT_EQ(wrong, 0);
}

Solid repaired(const Mesh& mesh, const std::string& words) {
  std::string note;
  const Solid s = make_tessellated("mesh", mesh, &note);
  EXPECT_NE(note.find(words), std::string::npos) << note;
  return s;
}

TEST(FacetsThatDoNotClose, ClosedOnesAreLeftAlone) {
  std::string note;
  make_tessellated("mesh", ball(), &note);
  EXPECT_EQ(note, "");
}

TEST(FacetsThatDoNotClose, FlippedOnesAreTurned) {
  for (const Mesh& given : {ball(), block()}) {
    const Solid whole = make_tessellated("whole", given);
    Mesh one = given;
    flip(one[3]);
    expect_same(repaired(one, "turned 1 facet"), whole);
    Mesh many = given;
    for (std::size_t i = 0; i < many.size(); i += 3) flip(many[i]);
    const Solid s = repaired(many, "turned");
    expect_same(s, whole);
    expect_navigable(s, 500);
    // Half of it, all in one part.
    Mesh half = given;
    for (std::size_t i = 0; i < half.size() / 2 - 1; ++i) flip(half[i]);
    expect_same(repaired(half, "turned"), whole);
  }
}

TEST(FacetsThatDoNotClose, DoubledOnesAreLeftOut) {
  for (const Mesh& given : {ball(), block()}) {
    const Solid whole = make_tessellated("whole", given);
    Mesh doubled = given;
    for (std::size_t i = 0; i < 5; ++i) {
      doubled.push_back({given[i][1], given[i][2], given[i][0]});
    }
    expect_same(repaired(doubled, "left out 5 doubled facets"), whole);
    doubled = given;
    doubled.push_back(given[4]);
    flip(doubled.back());
    expect_same(repaired(doubled, "left out 1 doubled facet"), whole);
  }
}

TEST(FacetsThatDoNotClose, TJunctionsAreClosed) {
  const Solid whole = make_tessellated("whole", block());
  for (const double off : {0.0, 1e-13, 1e-7}) {
    // The first facet is cut in two, its neighbour is not; and one in many.
    for (const int pieces : {2, 7}) {
      Mesh mesh = block();
      const FacetCorners f = mesh[0];
      mesh.erase(mesh.begin());
      const auto between = [&](int i) {
        const double k = static_cast<double>(i) / pieces;
        Vec3 p = (1 - k) * f[0] + k * f[1];
        if (i > 0 && i < pieces) p.z += off;
        return p;
      };
      for (int i = 0; i < pieces; ++i) mesh.push_back({between(i), between(i + 1), f[2]});
      const Solid s = repaired(mesh, "added");
      if (off < 1e-9) expect_same(s, whole);
      expect_navigable(s);
    }
  }
}

TEST(FacetsThatDoNotClose, DegenerateOnesDoNoHarm) {
  Mesh mesh = block();
  const Solid whole = make_tessellated("whole", mesh);
  const FacetCorners f = mesh[0];
  mesh.push_back({f[0], f[0], f[1]});                 // nothing is left of it
  mesh.push_back({f[0], 0.5 * (f[0] + f[1]), f[1]});  // no area
  mesh.push_back({f[2], f[2], f[2]});
  const Solid s = repaired(mesh, "open at");
  expect_same(s, whole);
  expect_navigable(s);
}

TEST(FacetsThatDoNotClose, HolesAreSpanned) {
  const Solid whole = make_tessellated("whole", block());
  for (std::size_t i = 0; i < 12; ++i) {
    Mesh mesh = block();
    mesh.erase(mesh.begin() + static_cast<std::ptrdiff_t>(i));
    expect_same(repaired(mesh, "added 1 facet"), whole);
    if (i < 10) {
      mesh.erase(mesh.begin() + static_cast<std::ptrdiff_t>(i));
      expect_navigable(repaired(mesh, "added"), 200);
    }
  }
  // A whole side.
  Mesh open = block();
  open.erase(open.begin() + 4, open.begin() + 6);
  expect_same(repaired(open, "added 2 facets"), whole);
}

TEST(FacetsThatDoNotClose, CornersThatAreNotQuiteOneAreJoined) {
  std::mt19937_64 random(3);
  for (const double off : {1e-9, 1e-7, 1e-6}) {
    Mesh mesh = ball(2);
    for (FacetCorners& f : mesh) {
      for (Vec3& p : f) p = p + off * unit_vector(random);
    }
    const Solid s = make_tessellated("mesh", mesh);
    EXPECT_NEAR(capacity(s), capacity(make_tessellated("whole", ball(2))), 1e-2);
    expect_navigable(s, 500);
  }
  // A foil with a flipped facet is not joined with itself.
  Mesh foil = block();
  for (FacetCorners& f : foil) {
    for (Vec3& p : f) p.z *= 1e-6;
  }
  const double volume = capacity(make_tessellated("foil", foil));
  flip(foil[1]);
  EXPECT_NEAR(capacity(repaired(foil, "turned 1 facet")), volume, 1e-9 * volume);
}

TEST(FacetsThatDoNotClose, WhateverIsLeftIsNavigated) {
  std::mt19937_64 random(7);
  int refused = 0;
  for (int i = 0; i < 40; ++i) {
    Mesh mesh = i % 2 == 0 ? ball(2) : block();
    for (int k = 0; k < 1 + i / 4; ++k) {
      const std::size_t at = random() % mesh.size();
      switch (random() % 5) {
        case 0:
          flip(mesh[at]);
          break;
        case 1:
          mesh.push_back(mesh[at]);
          break;
        case 2:
          mesh.erase(mesh.begin() + static_cast<std::ptrdiff_t>(at));
          break;
        case 3:
          mesh[at][random() % 3] = 8.0 * unit_vector(random);
          break;
        default:
          mesh[at][0] = 0.5 * (mesh[at][1] + mesh[at][2]);
      }
    }
    try {
      expect_navigable(make_tessellated("mesh", mesh), 100);
    } catch (const GeometryError&) {
      ++refused;
    }
    ASSERT_FALSE(HasFatalFailure()) << "mesh " << i;
  }
  EXPECT_LT(refused, 10);
}

TEST(FacetsThatDoNotClose, ThoseThatEncloseNothingAreRefused) {
  const Mesh all = block();
  EXPECT_THROW(make_tessellated("one", Mesh{all[0]}), GeometryError);
  EXPECT_THROW(make_tessellated("flat", Mesh{all[0], all[1]}), GeometryError);
  // Both sides of a sheet, turned so that no corner is exactly in its plane.
  const Vec3 u{0.48, 0.6, 0.64}, v{-0.8, 0.6, 0.0384};
  for (const double step : {1000.0, 0.1}) {
    const auto corner = [&](int i, int j) { return step * (i * u + j * v); };
    Mesh sheet;
    for (int i = 0; i < 40; ++i) {
      for (int j = 0; j < 40; ++j) {
        const FacetCorners front{corner(i, j), corner(i + 1, j), corner(i + 1, j + 1),
                                 corner(i, j + 1)};
        sheet.push_back(front);
        // Cut along the other diagonal, so that no facet is there twice.
        sheet.push_back({front[1], front[0], front[3], front[2]});
      }
    }
    EXPECT_THROW(make_tessellated("flat", sheet), GeometryError);
  }
}

TEST(FacetsThatDoNotClose, ThinOnesEncloseSomething) {
  // A wire of 12 m with a diameter of 10 micrometres, and one that published detectors have.
  for (const auto& [radius, length] : {std::pair{0.005, 12000.0}, {5e-6, 30.1}}) {
    Mesh wire;
    const auto corner = [r = radius, half = length / 2](int i, int end) {
      const double angle = std::numbers::pi / 4 * (i % 8);
      return Vec3{r * std::cos(angle), r * std::sin(angle), end * half};
    };
    for (int i = 0; i < 8; ++i) {
      const Vec3 a = corner(i, -1), b = corner(i + 1, -1), c = corner(i + 1, 1), d = corner(i, 1);
      wire.push_back({a, b, c, d});
      if (i > 0 && i < 7) wire.push_back({corner(0, -1), b, a});
      if (i > 0 && i < 7) wire.push_back({corner(0, 1), d, c});
    }
    const double expected = 2 * std::sqrt(2.0) * radius * radius * length;
    std::string note;
    const Solid solid = make_tessellated("wire", wire, &note);
    EXPECT_NEAR(capacity(solid), expected, 1e-6 * expected);
    EXPECT_EQ(note, "");
    const Vec3 start{-1, 0, 0.3 * radius};
    EXPECT_NEAR(distance_to_in(solid.any(), start, kernels::make_direction(1.0, 0.0, 0.0), tol),
                1 - radius, 1e-9);
  }
}

// --- Extruded solids ----------------------------------------------------------------------------

using Polygon = std::vector<PlanarPoint>;
const std::vector<ExtrudedSection> sections{{-3, 0, 0, 1}, {3, 0, 0, 1}};

/// How often a polygon winds around a point, by angles.
int windings(const Polygon& polygon, double x, double y) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const PlanarPoint &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double ax = a.x - x, ay = a.y - y, bx = b.x - x, by = b.y - y;
    sum += std::atan2(ax * by - ay * bx, ax * bx + ay * by);
  }
  return static_cast<int>(std::lround(sum / (2 * std::numbers::pi)));
}

void expect_surrounded(const Polygon& polygon, bool noted = false) {
  std::string note;
  const Solid s = make_extruded("x", polygon, sections, &note);
  if (noted) {
    EXPECT_NE(note, "");
  }
  std::mt19937_64 random(9);
  double area = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const PlanarPoint &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    area += a.x * b.y - a.y * b.x;
  }
  for (int i = 0; i < 3000; ++i) {
    const Vec3 p{uniform(random, -11, 11), uniform(random, -11, 11), uniform(random, -4, 4)};
    const Side side = inside(s.any(), p, tol);
    if (side == Side::surface) continue;
    const bool in = windings(polygon, p.x, p.y) * (area > 0 ? 1 : -1) > 0 && std::abs(p.z) < 3;
    ASSERT_EQ(side == Side::inside, in) << p.x << ' ' << p.y << ' ' << p.z;
  }
  expect_navigable(s, 1000);
}

TEST(PolygonsThatTouchThemselves, AreTakenForWhatTheySurround) {
  ASSERT_EQ(comb().size(), 30U);
  Polygon touching = comb();
  touching[1] = {-7, -8};  // the first tooth's corner on the next one's
  expect_surrounded(touching);
  touching = comb();
  touching[1] = {-7, -2};  // on the next one's side
  expect_surrounded(touching);
  touching[1] = {-7 + 1e-13, -2};
  expect_surrounded(touching);
  std::reverse(touching.begin(), touching.end());
  expect_surrounded(touching);
}

TEST(PolygonsThatTouchThemselves, MayCrossSlightly) {
  for (const double by : {1e-12, 1e-6, 1e-3, 0.02}) {
    Polygon crossing = comb();
    crossing[1] = {-7 + by, -2};
    expect_surrounded(crossing, by > 1e-9);
  }
  // Over at an upper corner, the other way round.
  Polygon bump = comb();
  bump.insert(bump.end() - 1, {{0.0, 8.0}, {0.01, 8.02}, {-0.01, 8.02}, {0.0, 8.0}});
  expect_surrounded(bump);
}

TEST(PolygonsThatTouchThemselves, AreRefusedWhereTheyCrossByMore) {
  const auto refusal = [](const Polygon& polygon) {
    try {
      make_extruded("x", polygon, sections);
    } catch (const GeometryError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const Polygon bow_tie{{-5, -5}, {5, 5}, {5, -5.5}, {-5, 5}};
  EXPECT_NE(refusal(bow_tie).find("crosses itself"), std::string::npos);
  EXPECT_NE(refusal({{-5, -5}, {5, 5}, {5, -5}, {-5, 5}}), "");
  Polygon crossing = comb();
  crossing[1] = {-5, -2};
  EXPECT_NE(refusal(crossing).find("crosses itself"), std::string::npos);
  Polygon pentagram;
  for (int i = 0; i < 5; ++i) {
    pentagram.push_back(
        {10 * std::cos(i * 0.8 * std::numbers::pi), 10 * std::sin(i * 0.8 * std::numbers::pi)});
  }
  EXPECT_NE(refusal(pentagram).find("twice or the wrong way round"), std::string::npos);
}

}  // namespace
}  // namespace navjit
