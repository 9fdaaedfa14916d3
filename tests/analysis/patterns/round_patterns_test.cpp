// Nests and rings: which daughters are about an axis, and that no candidate which is met is left
// out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

#include "analysis/axial_extent.hpp"
#include "analysis/patterns/nest.hpp"
#include "analysis/patterns/pattern.hpp"
#include "analysis/patterns/rings.hpp"
#include "analysis/plan.hpp"
#include "geometry/solids/list.hpp"
#include "navjit/vector.hpp"
#include "tests/analysis/patterns/arrangement.hpp"
#include "tests/support/worlds.hpp"

// clang-format off
#include "geometry/kernels/nest.h"
#include "geometry/kernels/rings.h"
// clang-format on

namespace navjit {
namespace {

using tests::Arrangement;
using tests::expect_complete;
using tests::Tally;
using tests::uniform;

constexpr double pi = std::numbers::pi, inf = INFINITY;
constexpr double tolerance = tests::pattern_tolerance, margin = 1e-6;

const std::array<std::array<int, 3>, 3> across_and_along{{{1, 2, 0}, {2, 0, 1}, {0, 1, 2}}};

std::array<double, 3> seen_from(const Vec3& p, int axis) {
  const double c[3] = {p.x, p.y, p.z};
  const auto& order = across_and_along[static_cast<std::size_t>(axis)];
  return {c[order[0]], c[order[1]], c[order[2]]};
}

Solid random_solid(std::mt19937_64& random) {
  const double a = uniform(random, 1, 5), b = a + uniform(random, 0.1, 3),
               h = uniform(random, 1, 6);
  const double start = uniform(random, -4, 4), delta = uniform(random, 0.2, 7);
  switch (random() % 7) {
    case 0:
      return make_box("s", a, b, h);
    case 1:
      return make_tube("s", random() % 3 == 0 ? 0 : a, b, h, start, delta);
    case 2:
      return make_cone("s", a, b, 0.5 * a, a, h, start, delta);
    case 3: {
      const ZPlane planes[] = {{-h, a, b}, {0, 0.3 * a, 2 * b}, {h, a, b}};
      return make_polycone("s", planes, start, delta);
    }
    case 4: {
      const ZPlane planes[] = {{-h, a, b}, {h, 0.3 * a, 2 * b}};
      return make_polyhedra("s", planes, 6, start, delta);
    }
    case 5:
      return make_trd("s", a, b, h, 0.5 * h, a);
    default:
      return make_sphere("s", a, b, start, delta, 0.3, 2);
  }
}

TEST(AxialExtent, HoldsEveryPointOfASolid) {
  std::mt19937_64 random(1);
  std::size_t points = 0, limited = 0, segments = 0;
  for (int round = 0; round < 600; ++round) {
    const int axis = round % 3;
    const Solid solid = random_solid(random);
    // Turned into the axis (either way round it), and by any angle about it; or just anyhow.
    const double about = uniform(random, -3, 3), flip = random() % 2 == 0 ? pi : 0;
    double r[9];
    const bool aligned = round % 2 == 0;
    if (!aligned) {
      rotation_from_angles(uniform(random, -3, 3), uniform(random, -3, 3), about, r);
    } else if (axis == 2) {
      rotation_from_angles(flip, 0, about, r);
    } else if (axis == 1) {
      rotation_from_angles(pi / 2 + flip, 0, about, r);
    } else {
      rotation_from_angles(0, pi / 2 + flip, about, r);
    }
    Vec3 at{0, 0, 0};
    if (!aligned || round % 4 == 0) {
      at = {uniform(random, -12, 12), uniform(random, -12, 12), uniform(random, -12, 12)};
    }
    const Transformation t = make_transformation({at.x, at.y, at.z}, r);
    const AxialExtent e = axial_extent(solid, t, axis), centre = central_extent(solid, t);
    limited += e.around ? 0 : 1;
    segments += e.segment ? 1 : 0;
    const Extent& box = solid.extent;
    for (int i = 0; i < 300; ++i) {
      const Vec3 q{uniform(random, box.min.x, box.max.x), uniform(random, box.min.y, box.max.y),
                   uniform(random, box.min.z, box.max.z)};
      if (inside(solid.any(), q, tolerance) == Side::outside) continue;
      ++points;
      const Vec3 p = to_outer(t, q);
      const auto [x, y, z] = seen_from(p, axis);
      const double radius = std::hypot(x, y);
      ASSERT_GE(radius, e.near - margin) << kind_name(solid.kind);
      ASSERT_LE(radius, e.far + margin) << kind_name(solid.kind);
      ASSERT_GE(z, e.low - margin);
      ASSERT_LE(z, e.high + margin);
      ASSERT_GE(norm(p), centre.near - margin);
      ASSERT_LE(norm(p), centre.far + margin);
      if (e.around) continue;
      const double beyond = std::remainder(std::atan2(y, x) - (e.first + e.span / 2), 2 * pi);
      ASSERT_LE(std::abs(beyond), e.span / 2 + 1e-6) << kind_name(solid.kind) << " axis " << axis;
    }
  }
  EXPECT_GT(points, 30000U);
  EXPECT_GT(limited, 100U);
  EXPECT_GT(segments, 50U);
}

void expect_complete_nest(const Arrangement& a, std::mt19937_64& random, double half,
                          Tally& tally) {
  const auto nest = find_nest(a.geometry->world(), a.mother(), a.daughters(), margin);
  ASSERT_TRUE(nest);
  const kernels::ShellNest<std::uint32_t> shells{static_cast<int>(nest->members.size()),
                                                 nest->near2.data(),
                                                 nest->far2.data(),
                                                 nest->members.data(),
                                                 nest->ends,
                                                 nest->low,
                                                 nest->high};
  const int axis = nest->axis;
  expect_complete(
      a, random, half,
      [&](const Vec3& p, const Direction& v, auto visit, auto reach) {
        for (const std::uint32_t k : nest->others) visit(k);
        double from = 0, to = inf;
        kernels::RadialRay ray = kernels::about_centre(p, v);
        if (axis < 3) {
          const auto [x, y, z] = seen_from(p, axis);
          const auto [vx, vy, vz] = seen_from({v.x, v.y, v.z}, axis);
          const auto inverse = seen_from({v.inverse_x, v.inverse_y, v.inverse_z}, axis);
          ray = kernels::about_axis(x, y, vx, vy);
          if (shells.ends)
            kernels::clip_to_ends(shells.low, shells.high, z, vz, inverse[2], from, to);
        }
        kernels::walk_shells(shells, ray, from, to, visit, reach);
      },
      [&](const Vec3& p, auto visit) {
        for (const std::uint32_t k : nest->others) visit(k);
        const auto [x, y, z] = seen_from(p, axis % 3);
        kernels::visit_shells_at(shells, axis < 3 ? x * x + y * y : x * x + y * y + z * z, visit);
      },
      tally);
}

TEST(Nest, LeadsToWhatTheRayMeetsFirst) {
  std::mt19937_64 random(2);
  Tally tally;
  for (int round = 0; round < 60; ++round) {
    const int axis = round % 4;
    const Vec3 turn = axis == 0 ? Vec3{0, pi / 2, 0} : axis == 1 ? Vec3{pi / 2, 0, 0} : Vec3{};
    Arrangement a(make_box("mother", 50, 50, 50));
    const std::size_t count = 3 + random() % 12;
    double r = round % 5 == 0 ? 0 : uniform(random, 0, 5);
    for (std::size_t i = 0; i < count; ++i) {
      if (random() % 2 == 0) r += uniform(random, 0, 2);  // else they touch
      const double next = r + uniform(random, 0.01, 2.5), h = uniform(random, 5, 40);
      const double delta = random() % 4 == 0 ? uniform(random, 1, 6) : 7;
      if (axis == 3) {
        a.add(make_sphere("s", r, next, 0, delta, 0, random() % 4 == 0 ? 2 : pi));
      } else if (random() % 4 == 0) {
        const ZPlane planes[] = {
            {-h, r, next}, {0, r, 0.5 * (r + next)}, {h, std::max(r, 0.9 * next), next}};
        a.add(make_polycone("s", planes, 0, 7), {}, turn);
      } else {
        const double z = uniform(random, -5, 5);
        a.add(make_tube("s", r, next, h, 0.3, std::max(delta, 3.3)),
              axis == 0   ? Vec3{z, 0, 0}
              : axis == 1 ? Vec3{0, z, 0}
                          : Vec3{0, 0, z},
              turn);
      }
      r = next;
    }
    if (round % 3 == 0) a.add(make_box("besides", 0.5, 1, 3), {45, 45, 0});
    a.finished(random);
    expect_complete_nest(a, random, 50, tally);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(tally.met, 4000U);
  EXPECT_LT(3 * tally.asked, tally.all) << "no filter at all";
}

using RayOf = std::function<tests::AskedRay(int)>;

/// `ray_of` gives the rays; null: rays of all kinds.
void expect_complete_rings(const Arrangement& a, std::mt19937_64& random, double half, Tally& tally,
                           RayOf ray_of = nullptr) {
  const auto rings = find_rings(a.geometry->world(), a.mother(), a.daughters(), margin);
  ASSERT_TRUE(rings);
  using Sectors = kernels::RingSectors<std::uint32_t>;
  std::vector<Sectors> sectors;
  for (const Ring& r : rings->rings) {
    sectors.push_back({r.near * r.near, r.far * r.far, r.low, r.high, r.hole, r.outside, r.ends,
                       r.steps, reinterpret_cast<const double(*)[2]>(r.edges.data()),
                       r.at_angle.data(), static_cast<double>(r.at_angle.size()) / 4,
                       static_cast<int>(r.at_angle.size()), r.reach, r.lean, r.first.data(),
                       r.members.data()});
  }
  const int axis = rings->axis;
  if (!ray_of) ray_of = [&](int i) { return tests::random_ray(random, a, half, i); };
  tests::expect_complete_for(
      a, random, half, ray_of,
      [&](const Vec3& p, const Direction& v, auto visit, auto reach) {
        for (const std::uint32_t k : rings->others) visit(k);
        const auto [x, y, z] = seen_from(p, axis);
        const auto [vx, vy, vz] = seen_from({v.x, v.y, v.z}, axis);
        const auto inverse = seen_from({v.inverse_x, v.inverse_y, v.inverse_z}, axis);
        const kernels::AxialRay ray{x, y, z, vx, vy, vz, inverse[2]};
        for (const Sectors& s : sectors) kernels::walk_ring(s, ray, visit, reach);
      },
      [&](const Vec3& p, auto visit) {
        for (const std::uint32_t k : rings->others) visit(k);
        const auto [x, y, z] = seen_from(p, axis);
        for (const Sectors& s : sectors) kernels::visit_sector_at(s, x, y, z, visit);
      },
      tally);
}

TEST(Rings, LeadToWhatTheRayMeetsFirst) {
  std::mt19937_64 random(3);
  Tally tally;
  for (int round = 0; round < 80; ++round) {
    const int axis = round % 3;
    const int steps = 3 + static_cast<int>(random() % 60);
    const double step = 2 * pi / steps;
    // Mothers with a bore, that are larger, and that are just as long.
    const double bore = round % 2 == 0 ? 0 : 18, wide = round % 4 == 0 ? 31 : 60;
    Arrangement a(make_tube("mother", bore, wide, round % 5 == 0 ? 10 : 50, 0, 7));
    const bool segments = random() % 2 == 0, gaps = random() % 2 == 0;
    // Segments that touch, leave gaps, or overlap (which is no valid geometry); boxes that do.
    const double fill = random() % 3 == 0 ? 1 : uniform(random, 0.2, 1.4);
    const Vec3 turn = axis == 0 ? Vec3{0, pi / 2, 0} : axis == 1 ? Vec3{pi / 2, 0, 0} : Vec3{};
    const double start = uniform(random, -3, 3), half = 12.5 * step * fill;
    for (int i = 0; i < steps; ++i) {
      if (gaps && i % 5 == 3 && steps > 6) continue;
      const double phi = start + i * step;
      if (segments) {
        a.add(make_tube("s", 20, 30, 10, phi, step * fill), {}, turn);
      } else {
        const Vec3 at = axis == 0   ? Vec3{0, 25 * std::cos(phi), 25 * std::sin(phi)}
                        : axis == 1 ? Vec3{25 * std::sin(phi), 0, 25 * std::cos(phi)}
                                    : Vec3{25 * std::cos(phi), 25 * std::sin(phi), 0};
        // The box's y is along the azimuth; its z stays along the axis.
        Vec3 angles{0, 0, -phi};
        Vec3 size{4, std::min(half, 6.0), 9};
        if (axis == 0) angles = {-phi, 0, 0}, size = {9, 4, std::min(half, 6.0)};
        if (axis == 1) angles = {0, -phi, 0}, size = {std::min(half, 6.0), 9, 4};
        a.add(make_box("s", size.x, size.y, size.z), at, angles);
      }
    }
    if (round % 3 == 0) a.add(make_box("besides", 1, 1, 3), {0, 0, 20});
    a.finished(random);
    expect_complete_rings(a, random, 50, tally);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(tally.met, 4000U);
  EXPECT_LT(3 * tally.asked, tally.all) << "no filter at all";
}

/// Boxes in a ring about axis 0, 1 or 2. The first edge of each is inclined to the radius by some
/// angle, anticlockwise.
void add_leaning(Arrangement& a, int steps, double start, double radius, double leaning, int axis,
                 double thick, bool gaps = false) {
  for (int i = 0; i < steps; ++i) {
    if (gaps && i % 5 == 3) continue;
    const double phi = start + 2 * pi / steps * i, turn = -(phi + leaning);
    const double u = radius * std::cos(phi), v = radius * std::sin(phi);
    const Vec3 at = axis == 0 ? Vec3{0, u, v} : axis == 1 ? Vec3{v, 0, u} : Vec3{u, v, 0};
    const Vec3 angles = axis == 0   ? Vec3{turn, 0, 0}
                        : axis == 1 ? Vec3{0, turn, 0}
                                    : Vec3{0, 0, turn};
    const Vec3 size = axis == 0   ? Vec3{9, 4, thick}
                      : axis == 1 ? Vec3{thick, 9, 4}
                                  : Vec3{4, thick, 9};
    a.add(make_box("s", size.x, size.y, size.z), at, angles);
  }
}

/// A blade's middle is on the tangent to a circle of radius r sin(leaning).
TEST(Rings, OfLeaningBladesHaveEdgesOnTangents) {
  std::mt19937_64 random(8);
  for (const double leaning : {0.9, 0.4, -0.4, -0.9}) {
    for (const int axis : {0, 1, 2}) {
      Arrangement a(make_tube("mother", 0, 60, 50, 0, 7));
      add_leaning(a, 200, 0.1, 40, leaning, axis, 0.1);
      a.finished(random);
      const auto rings = find_rings(a.geometry->world(), a.mother(), a.daughters(), margin);
      ASSERT_TRUE(rings);
      ASSERT_EQ(rings->axis, axis);
      ASSERT_EQ(rings->rings.size(), 1U);
      const Ring& ring = rings->rings[0];
      EXPECT_EQ(ring.steps, 200);
      EXPECT_TRUE(ring.hole);
      EXPECT_NEAR(ring.lean, -40 * std::sin(leaning), 1e-9);
      EXPECT_LT(ring.members.size(), 500U);  // by radii each would be in dozens of sectors
    }
  }
  Arrangement upright(make_tube("mother", 0, 60, 50, 0, 7)),
      wide(make_tube("mother", 0, 60, 50, 0, 7));
  add_leaning(upright, 200, 0.1, 40, 0, 2, 0.1);
  add_leaning(wide, 20, 0.1, 40, 0.2, 2, 4);
  for (Arrangement* a : {&upright, &wide}) {
    a->finished(random);
    const auto rings = find_rings(a->geometry->world(), a->mother(), a->daughters(), margin);
    ASSERT_TRUE(rings);
    EXPECT_EQ(rings->rings[0].lean, 0);
  }
}

TEST(Plan, SaysThatARingLeans) {
  std::mt19937_64 random(11);
  for (const double leaning : {0.0, 0.8}) {
    Arrangement a(make_tube("mother", 0, 60, 50, 0, 7));
    add_leaning(a, 60, 0.1, 30, leaning, 2, 0.1);
    a.finished(random);
    WorldFacts facts = analyse_world(*a.geometry);
    facts.forced_candidates[0] = Candidates::rings;
    const std::string text = describe(*a.geometry, plan_scene(*a.geometry, facts, 0));
    const std::string ring = "60 of 60 in a ring";
    EXPECT_NE(text.find(ring + (leaning > 0 ? " that leans," : ",")), std::string::npos) << text;
  }
}

TEST(Rings, OfLeaningBladesLeadToWhatTheRayMeetsFirst) {
  std::mt19937_64 random(9);
  Tally tally;
  for (int round = 0; round < 60; ++round) {
    const double bore = round % 2 == 0 ? 0 : 20, wide = round % 4 == 0 ? 45 : 60;
    Arrangement a(make_tube("mother", bore, wide, round % 5 == 0 ? 10 : 50, 0, 7));
    const int axis = round % 2 == 0 ? round / 2 % 3 : 2;
    const double leaning = (random() % 2 == 0 ? 1 : -1) * uniform(random, 0.3, 1.2);
    const int steps = 20 + static_cast<int>(random() % 100);
    // Blades that may touch, and overlap, where they are nearest to the axis.
    add_leaning(a, steps, uniform(random, -3, 3), 30, leaning, axis, uniform(random, 0.05, 0.5),
                random() % 2 == 0);
    if (round % 4 == 3) add_leaning(a, 40, 0, 40, -leaning, axis, 0.2);
    if (round % 3 == 0) a.add(make_box("besides", 1, 1, 3), {0, 0, 20});
    a.finished(random);
    expect_complete_rings(a, random, 50, tally);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(tally.met, 4000U);
  EXPECT_LT(6 * tally.asked, tally.all) << "no filter at all";
}

/// Rays that are tangents of the circle itself stay between two blades.
TEST(Rings, OfLeaningBladesTakeRaysAlongThem) {
  std::mt19937_64 random(10);
  for (const double leaning : {0.7, -0.7}) {
    Arrangement a(make_tube("mother", 0, 60, 50, 0, 7));
    add_leaning(a, 80, 0.1, 30, leaning, 2, 0.1);
    a.finished(random);
    Tally tally;
    for (int round = 0; round < 10; ++round) {
      expect_complete_rings(a, random, 50, tally, [&](int) {
        const Daughter& of = a.daughters()[random() % a.daughters().size()];
        const double off = random() % 2 == 0 ? 0.1 : uniform(random, -0.3, 0.3);
        const Vec3 from{uniform(random, -6, 6), off, uniform(random, -9, 9)};
        const double way = random() % 2 == 0 ? 1 : -1;
        const Vec3 along{way, random() % 2 == 0 ? 0 : uniform(random, -1e-9, 1e-9), 0};
        const Vec3 at = to_outer(of.transformation, from);
        const Vec3 to = to_outer(of.transformation, from + along);
        return tests::AskedRay{at, (1 / norm(to - at)) * (to - at)};
      });
      if (HasFatalFailure()) return;
    }
    EXPECT_GT(tally.met, 1000U);
  }
}

TEST(RoundPatterns, AreNamed) {
  std::mt19937_64 random(4);
  const auto name = [](const Arrangement& a) {
    return describe_round_pattern(a.geometry->world(), a.mother(), a.daughters(), margin);
  };
  Arrangement nest(make_box("mother", 50, 50, 50));
  for (int i = 0; i < 6; ++i) nest.add(make_tube("s", 5 * i, 5 * i + 5, 20, 0, 7));
  nest.add(make_box("besides", 1, 1, 1), {40, 40, 0});
  nest.finished(random);
  EXPECT_EQ(name(nest), "nest of 6 shells about z and 1 more");
  Arrangement ring(make_box("mother", 50, 50, 50));
  for (int i = 0; i < 24; ++i) {
    if (i == 7) continue;
    ring.add(make_box("s", 4, 2, 9), {30 * std::cos(pi / 12 * i), 30 * std::sin(pi / 12 * i), 0},
             {0, 0, -pi / 12 * i});
  }
  ring.finished(random);
  EXPECT_EQ(name(ring), "ring of 23 of 24 about z");
  Arrangement heap(make_box("mother", 50, 50, 50));
  for (int i = 0; i < 9; ++i) {
    heap.add(make_box("s", 1, 1, 1), {5.0 * i - 20, uniform(random, -40, 40), 0});
  }
  heap.finished(random);
  EXPECT_EQ(name(heap), "");
}

TEST(Plan, WalksNestsAndRingsOfSegments) {
  std::mt19937_64 random(5);
  const auto plan = [](const Arrangement& a) {
    return plan_scene(*a.geometry, analyse_world(*a.geometry), 0);
  };
  Arrangement nest(make_box("mother", 50, 50, 50));
  for (int i = 0; i < 6; ++i) nest.add(make_tube("s", 5 * i, 5 * i + 5, 20, 0, 7));
  nest.finished(random);
  EXPECT_EQ(plan(nest).candidates, Candidates::nest);
  Arrangement ring(make_box("mother", 50, 50, 50)), modules(make_box("mother", 50, 50, 50));
  for (int i = 0; i < 24; ++i) {
    const double phi = pi / 12 * i;
    ring.add(make_tube("s", 20, 30, 10, 0, pi / 12), {}, {0, 0, phi});
    modules.add(make_box("s", 4, 2, 9), {30 * std::cos(phi), 30 * std::sin(phi), 0}, {0, 0, -phi});
  }
  ring.finished(random);
  modules.finished(random);
  EXPECT_EQ(plan(ring).candidates, Candidates::rings);
  // Boxes tell these better.
  EXPECT_EQ(plan(modules).candidates, Candidates::scan);
}

}  // namespace
}  // namespace navjit
