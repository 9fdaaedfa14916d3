// Rows of wires: they are found, no candidate which is met is left out, and a safety leaves out
// none that is nearer.
#include "analysis/patterns/wires.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "analysis/plan.hpp"
#include "geometry/navigation/scene.hpp"
#include "tests/analysis/patterns/arrangement.hpp"
#include "tests/support/wires.hpp"

namespace navjit {
namespace {

using tests::Arrangement;
using tests::Stringing;
using tests::uniform;

constexpr double margin = 1e-6;

std::optional<Wires> wires_of(const Arrangement& a) {
  return find_wires(a.geometry->world(), a.mother(), a.daughters(), margin);
}

std::size_t rows_of(const Wires& wires) {
  return std::accumulate(wires.bundles.begin(), wires.bundles.end(), std::size_t{0},
                         [](std::size_t sum, const WireBundle& b) { return sum + b.rows.size(); });
}

Arrangement chamber() { return Arrangement(make_box("mother", 90, 90, 90)); }

/// The kernel's form of a plan's wires; keeps the rows alive.
struct KernelWires {
  std::vector<std::vector<kernels::WireRow<std::uint32_t>>> rows;
  std::vector<kernels::WireBundle<std::uint32_t>> bundles;

  explicit KernelWires(const Wires& wires) {
    for (const WireBundle& b : wires.bundles) {
      auto& made = rows.emplace_back();
      for (const WireRow& r : b.rows) {
        made.push_back({r.at, r.half_u, r.half_n, r.radius, static_cast<int>(r.u.size()),
                        r.u.data(), r.members.data(), r.origin, 1 / r.width,
                        static_cast<int>(r.first.size()) - 1, r.first.data()});
      }
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const WireBundle& b = wires.bundles[i];
      kernels::WireBundle<std::uint32_t> k{};
      std::copy(b.across.begin(), b.across.end(), k.across);
      std::copy(b.normal.begin(), b.normal.end(), k.normal);
      std::copy(b.along.begin(), b.along.end(), k.along);
      k.count = static_cast<unsigned>(rows[i].size());
      k.rows = rows[i].data();
      k.ends = b.ends;
      k.low = b.low;
      k.high = b.high;
      k.round = b.round;
      bundles.push_back(k);
    }
  }
};

TEST(Wires, AreFoundHoweverTheyAreStrung) {
  for (const auto& [name, s] : tests::stringings()) {
    SCOPED_TRACE(name);
    std::mt19937_64 random(1);
    Arrangement a = chamber();
    const int strung = tests::string_wires(a.world, 0, s, random);
    a.finished(random);
    const auto wires = wires_of(a);
    ASSERT_TRUE(wires);
    EXPECT_EQ(rows_of(*wires), static_cast<std::size_t>(s.layers));
    EXPECT_EQ(wires->bundles.size(), 1U);
    EXPECT_TRUE(wires->others.empty());
    const tests::WireAxes axes = tests::axes_of(s);
    const WireBundle& b = wires->bundles[0];
    const auto product = [](const std::array<double, 3>& u, const Vec3& v) {
      return std::abs(u[0] * v.x + u[1] * v.y + u[2] * v.z);
    };
    EXPECT_NEAR(product(b.along, axes.along), 1, 1e-5);
    EXPECT_NEAR(product(b.across, axes.across), 1, 1e-3);
    for (const WireRow& row : b.rows) {
      EXPECT_TRUE(std::is_sorted(row.u.begin(), row.u.end()));
      EXPECT_LT(row.half_n, (s.bars ? 2.5 : 1.05) * s.radius + 2 * s.jitter + 2 * s.skew * s.half);
    }
    const std::string text = std::to_string(strung) + " wires in " + std::to_string(s.layers) +
                             (s.layers == 1 ? " row" : " rows");
    EXPECT_EQ(describe_wires(*wires), text);
    const ScenePlan plan = plan_scene(*a.geometry, analyse_world(*a.geometry), 0);
    // Few enough along an axis are slabs, which take little of the chamber's cross-section.
    const bool slabs = plan.pattern.find("slabs") != std::string::npos;
    EXPECT_EQ(plan.candidates, slabs ? Candidates::scan : Candidates::wires);
    EXPECT_EQ(wires->safety_known, s.skew == 0 && name != "bars anyhow");
  }
}

TEST(Wires, OfTwoDirectionsWithSomethingBeside) {
  std::mt19937_64 random(2);
  Arrangement a = chamber();
  Stringing u, v;
  u.angles = {0.9, 0, 0};
  u.middle = {-5, 0, 0};
  v.angles = {-0.9, 0, 0};
  v.middle = {5, 0, 0};
  const int strung =
      tests::string_wires(a.world, 0, u, random) + tests::string_wires(a.world, 0, v, random);
  a.add(make_box("frame", 80, 1, 1), {0, 85, 0});
  a.add(make_tube("pipe", 0, 4, 60, 0, 7), {40, 0, 0});
  a.finished(random);
  const auto wires = wires_of(a);
  ASSERT_TRUE(wires);
  EXPECT_EQ(wires->bundles.size(), 2U);
  EXPECT_EQ(wires->others.size(), 2U);
  EXPECT_EQ(describe_wires(*wires), std::to_string(strung) + " wires in 2 rows and 2 more");
}

TEST(Wires, WhatIsNoneIsNotTaken) {
  std::mt19937_64 random(3);
  Arrangement heap = chamber();
  for (int i = 0; i < 60; ++i) {
    const auto at = [&] { return uniform(random, -80, 80); };
    heap.add(make_tube("t", 0, 1, 20, 0, 7), {at(), at(), at()}, {at(), at(), at()});
  }
  heap.finished(random);
  EXPECT_FALSE(wires_of(heap));
  Arrangement nest = chamber();
  for (int i = 0; i < 20; ++i) nest.add(make_tube("t", i, i + 0.5, 80, 0, 7));
  nest.finished(random);
  EXPECT_FALSE(wires_of(nest)) << "all are at one place";
  Arrangement plates = chamber();
  for (int i = 0; i < 40; ++i) plates.add(make_box("p", 50, 50, 1), {0, 0, 4.0 * i - 80});
  plates.finished(random);
  EXPECT_FALSE(wires_of(plates)) << "none is elongated";
  Arrangement thick = chamber();
  for (int i = 0; i < 40; ++i) thick.add(make_tube("t", 0, 20, 80, 0, 7), {2.0 * i - 40, 0, 0});
  thick.finished(random);
  EXPECT_FALSE(wires_of(thick)) << "rows of what overlaps many times tell nothing";
}

TEST(Wires, LeadToWhatTheRayMeetsFirst) {
  tests::Tally tally;
  for (const auto& [name, s] : tests::stringings()) {
    SCOPED_TRACE(name);
    for (const std::uint64_t seed : {4, 5}) {
      std::mt19937_64 random(seed);
      Arrangement a = chamber();
      tests::string_wires(a.world, 0, s, random);
      if (seed == 5) a.add(make_box("beside", 1, 1, 3), {45, 45, 0});
      a.finished(random);
      const auto wires = wires_of(a);
      ASSERT_TRUE(wires);
      const KernelWires kernel(*wires);
      tests::expect_complete_for(
          a, random, 90,
          [&](int i) {
            auto [p, d] = tests::ray_among_wires(random, s, i);
            if (i % 4 == 1) {  // where it meets a wire
              const Daughter& of = a.daughters()[random() % a.daughters().size()];
              const double t = tests::distance(of, p, kernels::make_direction(d.x, d.y, d.z));
              if (t < INFINITY) p += t * d;
              if (i % 8 == 1) d = tests::random_direction(random);
            }
            return tests::AskedRay{p, d};
          },
          [&](const Vec3& p, const Direction& v, auto visit, auto reach) {
            for (const std::uint32_t k : wires->others) visit(k);
            for (const auto& b : kernel.bundles) kernels::walk_wires(b, p, v, visit, reach);
          },
          [&](const Vec3& p, auto visit) {
            for (const std::uint32_t k : wires->others) visit(k);
            for (const auto& b : kernel.bundles) kernels::visit_wires_at(b, p, visit);
          },
          tally);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(tally.met, 3000U);
  EXPECT_LT(10 * tally.asked, tally.all) << "no filter at all";
}

TEST(Wires, OfferFewToRaysAcrossThem) {
  std::mt19937_64 random(6);
  Arrangement a(make_box("mother", 400, 5, 90));
  Stringing s;
  s.wires = 350;
  s.radius = 0.05;
  s.angles = {0, 0.5, 0};
  tests::string_wires(a.world, 0, s, random);
  a.finished(random);
  const auto wires = wires_of(a);
  ASSERT_TRUE(wires);
  const KernelWires kernel(*wires);
  std::size_t offered = 0, rays = 4000;
  for (std::size_t i = 0; i < rays; ++i) {
    const Vec3 d = tests::random_direction(random);
    const Vec3 p{uniform(random, -300, 300), uniform(random, -5, 5), uniform(random, -80, 80)};
    for (const auto& b : kernel.bundles) {
      kernels::walk_wires(
          b, p, kernels::make_direction(d.x, d.y, d.z), [&](unsigned) { ++offered; },
          [] { return 20.0; });
      kernels::visit_wires_at(b, p, [&](unsigned) { ++offered; });
    }
  }
  EXPECT_GT(offered, 0U);
  EXPECT_LT(offered, rays / 4) << "of 350";
}

TEST(Wires, BoundTheSafety) {
  std::size_t asked = 0, all = 0;
  for (const auto& [name, s] : tests::stringings()) {
    SCOPED_TRACE(name);
    std::mt19937_64 random(7);
    Arrangement a = chamber();
    tests::string_wires(a.world, 0, s, random);
    a.finished(random);
    const auto wires = wires_of(a);
    ASSERT_TRUE(wires);
    if (!wires->safety_known) continue;
    const KernelWires kernel(*wires);
    for (int i = 0; i < 400; ++i) {
      const Vec3 p = tests::ray_among_wires(random, s, i).first;
      const auto away = [&](unsigned k) {
        const Daughter& d = a.daughters()[k];
        return safety_to_in(d.solid, to_local(d.transformation, p));
      };
      const double from = i % 2 == 0 ? INFINITY : uniform(random, 0, 5);
      double right = from;
      for (unsigned k = 0; k < a.daughters().size(); ++k) right = std::min(right, away(k));
      double got = from;
      for (const auto& b : kernel.bundles) {
        got = kernels::safety_among_wires(b, p, got, [&](unsigned k, double least) {
          ++asked;
          return std::min(least, away(k));
        });
      }
      ASSERT_EQ(got, right) << p.x << ' ' << p.y << ' ' << p.z;
      all += a.daughters().size();
    }
  }
  EXPECT_GT(all, 0U);
  EXPECT_LT(5 * asked, all) << "no filter at all";
}

}  // namespace
}  // namespace navjit
