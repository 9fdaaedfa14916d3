// The instrument itself: it must report what is wrong, and must not report what is right.
#include "apps/accuracy/judge.hpp"

#include <gtest/gtest.h>

#include "apps/accuracy/levels.hpp"
#include "apps/accuracy/track.hpp"
#include "tests/support/worlds.hpp"

namespace navjit::accuracy {
namespace {

struct Bench {
  std::shared_ptr<const World> world;
  reference::WideGeometry reference;
  Runtime runtime;
  Navigator navigator;

  explicit Bench(World made)
      : world(std::make_shared<const World>(std::move(made))),
        reference(world),
        runtime(world, {.jit = JitMode::off}),
        navigator(runtime.navigator()) {}

  Ray random_ray(std::mt19937_64& random) const {
    const auto coordinate = [&] { return tests::uniform(random, -90, 90); };
    const double x = coordinate(), y = coordinate(), z = coordinate();
    return {{x, y, z}, tests::random_direction(random)};
  }
  JudgedRay judge(const Ray& ray, const MadeRay& made) const {
    return judge_ray(reference, ray, made, own_tolerances(*world));
  }
};

std::size_t wrong_steps(const JudgedRay& judged) {
  std::size_t wrong = 0;
  for (const JudgedStep& step : judged.steps) wrong += step.wrong_end || step.wrong_volume ? 1 : 0;
  return wrong;
}

TEST(Judge, FindsNoFaultWithTheGenericNavigator) {
  Bench bench(tests::mixed_world());
  std::mt19937_64 random(1);
  std::size_t steps = 0;
  for (std::size_t i = 0; i < 600; ++i) {
    const Ray ray = bench.random_ray(random);
    const MadeRay made = make_ray_steps(bench.navigator, *bench.world, ray, i);
    const JudgedRay judged = bench.judge(ray, made);
    EXPECT_FALSE(judged.lost || judged.stuck);
    EXPECT_EQ(judged.arguable, 0u);
    ASSERT_EQ(judged.steps.size(), made.steps.size());
    for (const JudgedStep& step : judged.steps) {
      EXPECT_FALSE(step.wrong_end || step.wrong_volume);
      EXPECT_LE(step.across, 4 * step.ulp) << "in " << made.steps[step.step].volume;
      EXPECT_LE(step.across, step.error);
    }
    steps += made.steps.size();
  }
  EXPECT_GT(steps, 1000u);
}

/// Changes a ray's steps into wrong ones, at a step that is not the last.
using Spoil = void (*)(MadeRay& made, std::size_t step);

void expect_told(Spoil spoil, bool JudgedStep::*fault) {
  Bench bench(tests::mixed_world());
  std::mt19937_64 random(2);
  std::size_t spoilt = 0, told = 0;
  for (std::size_t i = 0; i < 500; ++i) {
    const Ray ray = bench.random_ray(random);
    MadeRay made = make_ray_steps(bench.navigator, *bench.world, ray, i);
    if (made.steps.size() < 3) continue;
    spoil(made, made.steps.size() / 2);
    ++spoilt;
    const JudgedRay judged = bench.judge(ray, made);
    bool found = false;
    for (const JudgedStep& step : judged.steps) found = found || step.*fault;
    told += found ? 1 : 0;
  }
  ASSERT_GT(spoilt, 50u);
  EXPECT_EQ(told, spoilt);
}

TEST(Judge, TellsAStepThatIsTooLong) {
  expect_told([](MadeRay& made, std::size_t i) { made.steps[i].length += 1e-3; },
              &JudgedStep::wrong_end);
}

TEST(Judge, TellsAStepThatIsTooShort) {
  expect_told(
      [](MadeRay& made, std::size_t i) {
        made.steps[i].length /= 2;
        // The next one starts there, in what should not have begun yet.
        made.steps[i + 1].length += made.steps[i].length;
      },
      &JudgedStep::wrong_end);
}

TEST(Judge, TellsAWrongNextVolume) {
  expect_told(
      [](MadeRay& made, std::size_t i) { made.steps[i].touchable = made.steps[i - 1].touchable; },
      &JudgedStep::wrong_volume);
}

/// A plate far thinner than the steps beside it; a ray crosses it at right angles.
World world_with_plate(double thickness) {
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 100, 100, 100));
  const VolumeId plate =
      tests::add_volume(world, "plate", make_box("plate", thickness / 2, 50, 50));
  tests::place(world, world.top, plate, {20 + thickness / 2, 0, 0});
  finish(world);
  return world;
}

TEST(Judge, TellsAThinVolumeThatIsPassed) {
  for (const double thickness : {1.0, 1e-3, 1e-6}) {
    for (const double short_by : {0.5, 2.0, 3.9}) {  // tolerances
      Bench bench(world_with_plate(thickness));
      const Ray ray{{-50, 1, 2}, {1, 0, 0}};
      MadeRay made = make_ray_steps(bench.navigator, *bench.world, ray, 0);
      ASSERT_EQ(made.steps.size(), 3U);
      EXPECT_EQ(wrong_steps(bench.judge(ray, made)), 0U);
      made.steps.erase(made.steps.begin() + 1);  // on as if there were no plate
      made.steps[0].length -= short_by * bench.world->tolerance;
      made.steps[1].point.x = -50 + made.steps[0].length;
      made.steps[1].length = 100 - made.steps[1].point.x;
      const JudgedRay judged = bench.judge(ray, made);
      EXPECT_EQ(wrong_steps(judged), 1U) << thickness << " mm, " << short_by << " tolerances short";
      EXPECT_EQ(judged.arguable, 1U) << "what comes after the first step";
    }
  }
}

TEST(Judge, TellsAThinVolumeThatIsPassedByNamesAlone) {
  Bench bench(world_with_plate(1e-2));
  for (const double x : {-99.0, -50.0}) {  // the plate is in the step's second half, in its first
    const Ray ray{{x, 1, 2}, {1, 0, 0}};
    MadeRay made = make_ray_steps(bench.navigator, *bench.world, ray, 0);
    ASSERT_EQ(made.steps.size(), 3U);
    made.steps.resize(1);
    made.steps[0].length = 100 - x;
    made.steps[0].touchable.reset();
    const JudgedRay judged = judge_named_ray(bench.reference, ray, made, {1e-9, 1e-5});
    EXPECT_EQ(wrong_steps(judged), 1U) << "from " << x;
  }
}

TEST(Judge, TellsALostRay) {
  Bench bench(tests::mixed_world());
  std::mt19937_64 random(3);
  for (std::size_t i = 0; i < 50; ++i) {
    const Ray ray = bench.random_ray(random);
    MadeRay made = make_ray_steps(bench.navigator, *bench.world, ray, i);
    made.end = made.steps.back().point;  // given up before the last step
    made.steps.pop_back();
    EXPECT_TRUE(bench.judge(ray, made).lost);
    made.steps.clear();
    EXPECT_TRUE(bench.judge(ray, made).lost) << "a start in the world that was not found";
  }
}

/// A box that sticks out of the world by 5 mm, and is longer than that.
World world_with_protrusion() {
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 100, 100, 100));
  const VolumeId box = tests::add_volume(world, "box", make_box("box", 40, 10, 10));
  tests::place(world, world.top, box, {65, 0, 0});
  finish(world);
  return world;
}

TEST(Judge, FindsARayArguableThatLeavesWhereAVolumeSticksOut) {
  Bench bench(world_with_protrusion());
  const auto expect = [&](const Ray& ray, bool lost, std::size_t arguable, double further = 0) {
    for (const bool named : {false, true}) {
      MadeRay made = make_ray_steps(bench.navigator, *bench.world, ray, 0);
      ASSERT_FALSE(made.steps.empty());
      made.end += further * ray.direction;
      if (named) {
        for (MadeStep& step : made.steps) step.touchable.reset();
      }
      const JudgedRay judged = named ? judge_named_ray(bench.reference, ray, made, {1e-9, 1e-5})
                                     : bench.judge(ray, made);
      EXPECT_EQ(judged.lost, lost) << named;
      EXPECT_EQ(judged.arguable, arguable) << named;
      EXPECT_EQ(wrong_steps(judged), 0U) << named;
    }
  };
  expect({{0, 1, 2}, {1, 0, 0}}, false, 1);      // through all of the box
  expect({{99, 1, 2}, {1, 0, 0}}, false, 1);     // its last step is mostly outside
  expect({{0, 1, 2}, {-1, 0, 0}}, false, 0);     // the other way
  expect({{0, 20, 2}, {1, 0, 0}}, false, 0);     // beside the box
  expect({{0, 20, 2}, {1, 0, 0}}, true, 0, 5);   // beside it, and carried on
  expect({{0, 1, 2}, {-1, 0, 0}}, true, 0, 5);   // where nothing sticks out
  expect({{0, 1, 2}, {1, 0, 0}}, true, 0, -10);  // in the box, but within the world
}

TEST(Judge, JudgesByNamesAlone) {
  Bench bench(tests::mixed_world());
  const Tolerances tolerances{1e-9, 1e-5};
  std::mt19937_64 random(4);
  std::size_t told = 0, spoilt = 0;
  for (std::size_t i = 0; i < 500; ++i) {
    const Ray ray = bench.random_ray(random);
    MadeRay made = make_ray_steps(bench.navigator, *bench.world, ray, i);
    for (MadeStep& step : made.steps) step.touchable.reset();
    const JudgedRay judged = judge_named_ray(bench.reference, ray, made, tolerances);
    EXPECT_EQ(wrong_steps(judged), 0u);
    EXPECT_FALSE(judged.lost);
    for (const JudgedStep& step : judged.steps) EXPECT_LE(step.across, 4 * step.ulp);
    const std::size_t middle = made.steps.size() / 2;
    if (made.steps[middle].length < 1e-3) continue;
    made.steps[middle].volume = "elsewhere";
    ++spoilt;
    told += wrong_steps(judge_named_ray(bench.reference, ray, made, tolerances)) > 0 ? 1 : 0;
  }
  EXPECT_GT(spoilt, 100u);
  EXPECT_EQ(told, spoilt);
}

TEST(Judge, FollowsRaysIntoWhatSticksOut) {
  // The core sticks out of its mother, where a sister of the mother is: who comes from within is
  // in the core, who comes from outside in the sister.
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 100, 100, 100));
  const VolumeId mother = tests::add_volume(world, "mother", make_box("mother", 10, 10, 10));
  const VolumeId core = tests::add_volume(world, "core", make_box("core", 5, 5, 5));
  const VolumeId sister = tests::add_volume(world, "sister", make_box("sister", 5, 10, 10));
  tests::place(world, world.top, mother, {0, 0, 0});
  tests::place(world, mother, core, {8, 0, 0});
  tests::place(world, world.top, sister, {15, 0, 0});
  finish(world);
  Bench bench(std::move(world));
  const Ray ray{{-50, 0.5, 0.25}, {1, 0, 0}};
  MadeRay made = make_ray_steps(bench.navigator, *bench.world, ray, 0);
  ASSERT_EQ(made.steps.size(), 5U);
  ASSERT_EQ(made.steps[2].volume, "core");
  ASSERT_EQ(made.steps[2].length, 10);
  for (MadeStep& step : made.steps) step.touchable.reset();
  const JudgedRay judged = judge_named_ray(bench.reference, ray, made, {1e-9, 1e-5});
  EXPECT_EQ(wrong_steps(judged), 0U);
  EXPECT_EQ(judged.steps.size(), made.steps.size());
}

TEST(Judge, AgreesWithTheReferencesOwnTrace) {
  Bench bench(tests::random_world(5, 3));
  std::mt19937_64 random(5);
  for (int i = 0; i < 100; ++i) {
    const auto coordinate = [&] { return tests::uniform(random, -29, 29); };
    const double x = coordinate(), y = coordinate(), z = coordinate();
    const Ray ray{{x, y, z}, tests::random_direction(random)};
    bool stuck = false;
    const auto steps = bench.reference.trace(ray.position, ray.direction, stuck);
    ASSERT_FALSE(steps.empty());
    reference::Chain chain;
    auto point = reference::widen(ray.position);
    const auto direction = reference::widen_direction(ray.direction);
    ASSERT_TRUE(bench.reference.locate(point, direction, chain));
    for (const reference::WideStep& step : steps) {
      const reference::WideAnswer answer = bench.reference.step(chain, point, direction);
      EXPECT_EQ(static_cast<double>(answer.length), static_cast<double>(step.length));
      EXPECT_EQ(answer.inside, &step != &steps.back());
      point = kernels::advance(point, direction, answer.length);
      chain = answer.next;
    }
  }
}

TEST(Track, DriftsByRoundingOnly) {
  Bench bench(tests::mixed_world());
  const Track track = make_track(bench.reference, bench.navigator, 5000, 1);
  std::vector<LegEnd> ends = follow(bench.navigator, *bench.world, track);
  const TrackResult result = judge_track(*bench.world, track, ends);
  EXPECT_TRUE(result.complete);
  EXPECT_GE(result.boundaries, 5000u);
  EXPECT_GT(result.largest, 0);
  EXPECT_LT(result.largest, 5000 * result.ulp);
  // A push of 1e-6 mm is seen.
  ends.back().point.x += 1e-6;
  EXPECT_NEAR(judge_track(*bench.world, track, ends).drift, 1e-6, 1e-9);
  ends.pop_back();
  EXPECT_FALSE(judge_track(*bench.world, track, ends).complete);
}

}  // namespace
}  // namespace navjit::accuracy
