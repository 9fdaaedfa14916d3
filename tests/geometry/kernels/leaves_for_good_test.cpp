// A ray does not meet again what it has left for good: the kernels agree on this, wherever in a
// detector they are asked.
#include <gtest/gtest.h>

#include <functional>

#include "geometry/navigation/scene.hpp"
#include "geometry/solids/any_solid.hpp"
#include "geometry/solids/extent.hpp"
#include "tests/geometry/kernels/random_curved_solids.hpp"
#include "tests/geometry/kernels/random_flat_solids.hpp"
#include "tests/geometry/kernels/random_solids.hpp"

namespace navjit::test {
namespace {

constexpr double tolerance = 1e-9;

struct Exits {
  int for_good = 0, not_known = 0, met_again = 0;
};

/// Judged by the solid itself.
struct BySolid {
  bool operator()(const Solid& solid, const Vec3& placed, const Vec3& in_mother,
                  const Direction&) const {
    return kernels::visit(solid.any(), [&](const auto& shape) {
      return is_left_for_good(shape, in_mother - placed, tolerance);
    });
  }
};
/// Judged by the box around the solid, as neighbour lists hold it.
struct ByBox {
  bool operator()(const Solid& solid, const Vec3& placed, const Vec3& in_mother,
                  const Direction& v) const {
    const Extent& e = solid.extent;
    const double margin = 2 * tolerance + 1e-9 * largest_coordinate(e);
    const Vec3 low = e.min + placed, high = e.max + placed;
    const kernels::NeighbourList list{{low.x - margin, low.y - margin, low.z - margin},
                                      {high.x + margin, high.y + margin, high.z + margin},
                                      0,
                                      0,
                                      0,
                                      0,
                                      static_cast<float>(margin)};
    return kernels::comes_out_of_box(list, in_mother, v, tolerance);
  }
};

/// Rays go out of a solid whose frame is anywhere in a world of 20 m. Where they end they are asked
/// again in the frame of a mother, as a navigator does it: a few roundings away.
template <class ForGood>
Exits leave(const SolidCase& c, Random& random, int rays, const ForGood& for_good) {
  Exits exits;
  const auto anywhere = [&] {
    return Vec3{random.uniform(-1e4, 1e4), random.uniform(-1e4, 1e4), random.uniform(-1e4, 1e4)};
  };
  for (int i = 0; i < rays; ++i) {
    const Vec3 mother = anywhere(), placed = random.chance(0.5) ? anywhere() : Vec3{0, 0, 0};
    const Vec3 own = mother + placed;
    const Direction v = random.any_direction();
    const Vec3 start = random.point_in(c.solid.extent, 0) + own, local = start - own;
    if (!contains(c.solid.any(), local, v, tolerance)) continue;
    const double t = distance_to_out(c.solid.any(), local, v, tolerance);
    if (!(t > 0)) continue;
    const Vec3 end = start + t * Vec3{v.x, v.y, v.z};
    Vec3 p = (end - mother) - placed;
    const bool known = for_good(c.solid, placed, end - mother, v);
    // The point that a caller gives may differ by as much, and the ray goes on.
    const double off = random.chance(0.5) ? 0.25 * tolerance : 0;
    p += Vec3{random.uniform(-off, off), random.uniform(-off, off), random.uniform(-off, off)};
    const double again = distance_to_in(c.solid.any(), p, v, tolerance);
    if (known) {
      ++exits.for_good;
      EXPECT_EQ(again, INFINITY) << "ray " << i;
    } else {
      ++exits.not_known;
      exits.met_again += again < INFINITY ? 1 : 0;
    }
  }
  return exits;
}

template <class ForGood>
Exits leave_many(SolidCase (*make)(Random&), unsigned seed, const ForGood& for_good) {
  Random random(seed);
  Exits all;
  for (int i = 0; i < scaled(300); ++i) {
    const Exits one = leave(make(random), random, 100, for_good);
    all.for_good += one.for_good;
    all.not_known += one.not_known;
    all.met_again += one.met_again;
  }
  return all;
}

TEST(LeavesForGood, ConvexSolidsAreNotMetAgain) {
  for (const auto make : {random_box, random_trd, random_trap, random_tet, random_orb}) {
    const Exits exits = leave_many(make, 3, BySolid{});
    EXPECT_GT(exits.for_good, scaled(5000));
    EXPECT_EQ(exits.not_known, 0);
  }
}

TEST(LeavesForGood, TubesAndConesAreMetAgainThroughTheirBores) {
  for (const auto make : {random_tube, random_cone}) {
    const Exits exits = leave_many(make, 4, BySolid{});
    EXPECT_GT(exits.for_good, scaled(2000));
    EXPECT_GT(exits.met_again, scaled(100)) << "rays cross the bore";
  }
}

TEST(LeavesForGood, OfOtherSolidsNothingIsKnown) {
  for (const auto make : {random_turning_polycone, random_torus, random_arb8}) {
    EXPECT_EQ(leave_many(make, 5, BySolid{}).for_good, 0);
  }
}

/// All kinds, where a ray comes out of the box around them.
TEST(LeavesForGood, WhatIsInABoxIsNotMetOutsideOfIt) {
  int for_good = 0;
  for (const auto make : {random_tube,
                          random_cone,
                          random_sphere,
                          random_polycone,
                          random_turning_polycone,
                          random_polyhedra,
                          random_turning_polyhedra,
                          random_composite,
                          random_extruded,
                          random_prism,
                          random_tessellated,
                          random_bent_trap,
                          random_arb8,
                          random_cut_tube,
                          random_generic_polycone,
                          random_generic_polyhedra,
                          random_scaled,
                          random_torus,
                          random_ellipsoid,
                          random_eltube,
                          random_elcone,
                          random_paraboloid,
                          random_hype,
                          random_twistedbox,
                          random_twistedtrd,
                          random_twistedtrap,
                          random_twistedtubs}) {
    for_good += leave_many(make, 7, ByBox{}).for_good;
  }
  EXPECT_GT(for_good, scaled(20000));
}

/// A ray that runs nearly along a face of a tube or a ball, and hardly enters it.
void graze(const std::function<Solid(double)>& make) {
  Random random(6);
  int grazing = 0;
  for (int i = 0; i < scaled(20000); ++i) {
    const double r = random.scale(1e-2, 1e4), depth = random.scale(1e-10, 1e-3) * r;
    const Solid solid = make(r);
    const double phi = random.uniform(0, 6.3), x = std::cos(phi), y = std::sin(phi);
    const Direction v = kernels::make_direction(-y, x, 0.0);
    const double half_chord = std::sqrt(2 * r * depth);
    const Vec3 at{random.uniform(-1e4, 1e4), random.uniform(-1e4, 1e4), 0};
    const Vec3 start =
        at + Vec3{(r - depth) * x + half_chord * y / 2, (r - depth) * y - half_chord * x / 2, 0};
    const Vec3 local = start - at;
    if (!contains(solid.any(), local, v, tolerance)) continue;
    const double t = distance_to_out(solid.any(), local, v, tolerance);
    if (!(t > 0)) continue;
    ++grazing;
    const Vec3 p = (start + t * Vec3{v.x, v.y, v.z}) - at;
    ASSERT_TRUE(BySolid{}(solid, {0, 0, 0}, p, v));
    EXPECT_EQ(distance_to_in(solid.any(), p, v, tolerance), INFINITY) << r << ' ' << depth;
  }
  EXPECT_GT(grazing, scaled(5000));
}

TEST(LeavesForGood, RaysThatGrazeDoNotComeBack) {
  graze([](double r) { return make_tube("tube", 0, r, 10 * r, 0, 7); });
  graze([](double r) { return make_orb("orb", r); });
}

}  // namespace
}  // namespace navjit::test
