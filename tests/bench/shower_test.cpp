// The toy shower that benchmarks repeat with every engine.
#include "bench/shower.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "bench/flights.hpp"
#include "common/rays.hpp"
#include "navjit/builder.hpp"
#include "navjit/gdml.hpp"
#include "navjit/solids.hpp"

namespace navjit {
namespace {

Detector calorimeter() { return read_gdml(NAVJIT_DETECTORS_DIR "/shashlik.gdml"); }

std::vector<Ray> primaries(const Runtime& runtime, int count) {
  common::RaySource source;
  source.aim = "auto";
  const common::RayMaker maker(runtime.world(), source);
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) rays.push_back(maker.ray(static_cast<std::uint64_t>(i)));
  return rays;
}

RuntimeOptions generic() {
  RuntimeOptions options;
  options.jit = JitMode::off;
  return options;
}

std::uint64_t steps_of(const std::vector<peers::Flight>& flights) {
  std::uint64_t steps = 0;
  for (const peers::Flight& flight : flights) steps += flight.steps.size();
  return steps;
}

TEST(Shower, EveryParticleStopsOnce) {
  Runtime runtime(calorimeter(), generic());
  const auto flights = bench::shower(runtime, primaries(runtime, 50), {});
  ASSERT_GT(flights.size(), 20U);
  std::size_t secondaries = 0;
  for (const peers::Flight& flight : flights) {
    const auto count = [&](bool peers::FlightStep::*what) {
      return std::count_if(flight.steps.begin(), flight.steps.end(),
                           [&](const peers::FlightStep& step) { return step.*what; });
    };
    EXPECT_EQ(count(&peers::FlightStep::stops), count(&peers::FlightStep::secondary) + 1);
    EXPECT_TRUE(flight.steps.back().stops);
    secondaries += static_cast<std::size_t>(count(&peers::FlightStep::secondary));
  }
  EXPECT_GT(secondaries, 50U);
}

TEST(Shower, SpecialisedNavigatorsMakeTheSameFlights) {
  Runtime off(calorimeter(), generic());
  const auto flights = bench::shower(off, primaries(off, 50), {});
  RuntimeOptions options;
  options.jit = JitMode::wait;
  options.specialiser.constants = options.specialiser.structures = false;
  options.specialiser.solids = false;
  Runtime wait(calorimeter(), options);
  Navigator one = off.navigator(), other = wait.navigator();
  const bench::Followed right = bench::follow(one, flights, bench::Asked::whole);
  const bench::Followed got = bench::follow(other, flights, bench::Asked::whole);
  EXPECT_EQ(right.steps, steps_of(flights)) << "what was recorded is made again";
  EXPECT_EQ(got.steps, right.steps);
  EXPECT_EQ(std::bit_cast<std::uint64_t>(got.length), std::bit_cast<std::uint64_t>(right.length));
  EXPECT_EQ(std::bit_cast<std::uint64_t>(got.safeties),
            std::bit_cast<std::uint64_t>(right.safeties));
  EXPECT_GT(right.safeties, 0);
  EXPECT_EQ(bench::follow(one, flights, bench::Asked::none).safeties, 0);
  // Safeties that are told only as far as they matter change no step.
  const bench::Followed enough = bench::follow(one, flights, bench::Asked::enough);
  EXPECT_EQ(std::bit_cast<std::uint64_t>(enough.length),
            std::bit_cast<std::uint64_t>(right.length));
  EXPECT_LT(enough.safeties, 0.9 * right.safeties);
  EXPECT_GT(one.counts().within_safety, 0U);
  EXPECT_EQ(bench::follow(other, flights, bench::Asked::enough).safeties, enough.safeties);
}

TEST(Shower, PrimariesThatMakeNoStepHaveNoFlight) {
  Runtime runtime(calorimeter(), generic());
  const std::vector<Ray> rays = primaries(runtime, 5);
  for (const int none : {0, -1}) {
    bench::ShowerOptions options;
    options.most_steps = none;
    EXPECT_TRUE(bench::shower(runtime, rays, options).empty()) << none;
  }
  EXPECT_TRUE(bench::shower(runtime, {{{1e7, 0, 0}, {1, 0, 0}}}, {}).empty()) << "outside";
}

/// A block in a hall: its filling decides whether particles scatter there.
Detector block_of(double density) {
  DetectorBuilder builder;
  const auto carbon = builder.element({.name = "C", .z = 6, .a = 12.011});
  const auto thin = builder.material({.name = "thin", .density = 1e-6, .elements = {{carbon, 1}}});
  const auto filling =
      builder.material({.name = "filling", .density = density, .elements = {{carbon, 1}}});
  const auto hall = builder.volume("hall", make_box("hall", 1000, 1000, 1000), thin);
  const auto block = builder.volume("block", make_box("block", 300, 300, 300), filling);
  builder.place(block, hall, placed_at({0, 0, 0}), 0);
  return builder.build(hall);
}

TEST(Shower, ParticlesScatterInWhatIsDense) {
  const std::vector<Ray> rays{{{-900, 10, 20}, {1, 0, 0}}};
  Runtime gas(block_of(0.001), generic());
  const auto straight = bench::shower(gas, rays, {});
  ASSERT_EQ(straight.size(), 1U);
  EXPECT_EQ(straight[0].steps.size(), 3U) << "to the block, through it, and out of the hall";
  for (const peers::FlightStep& step : straight[0].steps) EXPECT_EQ(step.limit, peers::no_limit);

  Runtime dense(block_of(2), generic());
  bench::ShowerOptions options;
  options.mean_step = 5;
  options.most_steps = 400;
  double limits = 0;
  int limited = 0;
  const auto scattered = bench::shower(dense, rays, options);
  ASSERT_EQ(scattered.size(), 1U);
  for (const peers::FlightStep& step : scattered[0].steps) {
    if (step.limit == peers::no_limit) continue;
    limits += step.limit;
    ++limited;
  }
  ASSERT_GT(limited, 300);
  EXPECT_NEAR(limits / limited, 5, 1.5);
}

TEST(Shower, MayHaveAsManyStepsAsItsTypeCanSay) {
  Runtime gas(block_of(0.001), generic());
  bench::ShowerOptions options;
  options.most_steps = std::numeric_limits<int>::max();
  const auto flights = bench::shower(gas, {{{-900, 10, 20}, {1, 0, 0}}}, options);
  ASSERT_EQ(flights.size(), 1U);
  EXPECT_EQ(flights[0].steps.size(), 3U) << "to the block, through it, and out of the hall";
}

}  // namespace
}  // namespace navjit
