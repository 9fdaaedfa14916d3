// The optical photons that benchmarks repeat with every engine.
#include "bench/photons.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "bench/flights.hpp"
#include "common/rays.hpp"
#include "navjit/gdml.hpp"

namespace navjit {
namespace {

Runtime runtime_of(JitMode mode) {
  RuntimeOptions options;
  options.jit = mode;
  options.specialiser.constants = options.specialiser.structures = false;
  options.specialiser.solids = false;
  return Runtime(read_gdml(NAVJIT_DETECTORS_DIR "/shashlik.gdml"), options);
}

std::vector<peers::Flight> photons_of(Runtime& runtime, double reflected, int most_steps) {
  common::RaySource source;
  source.aim = "auto";
  const common::RayMaker maker(runtime.world(), source);
  std::vector<Ray> rays;
  for (std::uint64_t i = 0; i < 50; ++i) rays.push_back(maker.ray(i));
  bench::PhotonOptions options;
  options.reflected = reflected;
  options.most_steps = most_steps;
  return bench::photons(runtime, rays, options);
}

TEST(Photons, MirrorsKeepThemWhereTheyAre) {
  Runtime runtime = runtime_of(JitMode::off);
  const auto flights = photons_of(runtime, 1, 40);
  ASSERT_EQ(flights.size(), 50U);
  Navigator navigator = runtime.navigator();
  int kept = 0;
  for (const peers::Flight& flight : flights) {
    Vec3 point{flight.start[0], flight.start[1], flight.start[2]};
    State state = navigator.locate(point);
    const State home = state;
    if (home.touchable() == 0) continue;  // there is no mirror about the world
    ++kept;
    ASSERT_EQ(flight.steps.size(), 40U);
    for (const peers::FlightStep& step : flight.steps) {
      const auto& [u, v, w] = step.direction;
      bench::moved(navigator, state, point, {u, v, w}, 0.0);  // back from behind the mirror
      EXPECT_TRUE(state == home);
      bench::moved(navigator, state, point, {u, v, w}, peers::no_limit);
    }
  }
  EXPECT_GT(kept, 25);
}

TEST(Photons, WithoutMirrorsMostLeave) {
  Runtime runtime = runtime_of(JitMode::off);
  const auto flights = photons_of(runtime, 0, 10000);
  EXPECT_GT(std::count_if(flights.begin(), flights.end(),
                          [](const auto& flight) { return flight.steps.size() < 10000; }),
            45);
}

TEST(Photons, ThatMakeNoStepHaveNoFlight) {
  Runtime runtime = runtime_of(JitMode::off);
  EXPECT_TRUE(photons_of(runtime, 0.5, 0).empty());
  EXPECT_TRUE(photons_of(runtime, 0.5, -1).empty());
  const std::vector<Ray> outside{{{1e7, 0, 0}, {1, 0, 0}}};
  EXPECT_TRUE(bench::photons(runtime, outside, {}).empty());
}

TEST(Photons, SpecialisedNavigatorsMakeTheSameFlights) {
  Runtime off = runtime_of(JitMode::off), wait = runtime_of(JitMode::wait);
  const auto flights = photons_of(off, 0.5, 100);
  Navigator one = off.navigator(), other = wait.navigator();
  const bench::Followed right = bench::follow(one, flights, bench::Asked::none);
  const bench::Followed got = bench::follow(other, flights, bench::Asked::none);
  EXPECT_GT(right.steps, 1000U);
  EXPECT_EQ(got.steps, right.steps);
  EXPECT_EQ(std::bit_cast<std::uint64_t>(got.length), std::bit_cast<std::uint64_t>(right.length));
  EXPECT_LT(100 * other.counts().bail_outs, got.steps) << "reflections are no special case";
}

}  // namespace
}  // namespace navjit
