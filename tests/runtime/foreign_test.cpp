// Detectors with foreign solids are navigated as those with the library's own solids; what no code
// can be made for stays as it is.
#include <gtest/gtest.h>

#include <functional>
#include <thread>

#include "geometry/reference/wide_geometry.hpp"
#include "runtime/fingerprint.hpp"
#include "tests/support/foreign.hpp"
#include "tests/support/traces.hpp"

namespace navjit {
namespace {

using tests::Row;

using MakeBall = std::function<Solid(const std::string&, double)>;

/// Balls as daughters, as a mother, in booleans, placed, scaled and touching; also boxes.
World balls(const MakeBall& ball) {
  World world;
  const VolumeId hall = tests::add_volume(world, "hall", make_box("hall", 100, 100, 100));
  const VolumeId shell = tests::add_volume(world, "shell", ball("shell", 20));
  const VolumeId plate = tests::add_volume(world, "plate", make_box("plate", 8, 8, 1));
  const VolumeId bored = tests::add_volume(
      world, "bored", make_subtraction("bored", make_box("block", 25, 25, 10), ball("bore", 18)));
  const VolumeId egg = tests::add_volume(world, "egg", make_scaled("egg", ball("e", 10), 1, 2, 3));
  const VolumeId moved =
      tests::add_volume(world, "moved", make_placed("moved", ball("m", 15), SolidFrame{{3, 4, 5}}));
  const VolumeId core = tests::add_volume(world, "core", ball("core", 5));
  world.top = hall;
  tests::place(world, shell, plate, {0, 0, -3});
  tests::place(world, shell, core, {0, 0, 5});
  for (const double x : {-60.0, -20.0, 20.0}) tests::place(world, hall, shell, {x, 40, 0});
  tests::place(world, hall, bored, {-50, -40, 30});
  tests::place(world, hall, egg, {30, -40, 0});
  tests::place(world, hall, moved, {-20, -50, -60});
  for (const double x : {-70.0, 0.0, 70.0}) tests::place(world, hall, plate, {x, 0, 80});
  finish(world);
  return world;
}

std::vector<Row> without_slivers(std::vector<Row> rows) {
  std::erase_if(rows, [](const Row& row) { return row.length < 1e-7; });
  return rows;
}

RuntimeOptions eager(JitMode jit) { return tests::eager_options(jit); }

TEST(ForeignSolids, AreNavigatedAsTheLibrarysOwn) {
  const auto own = std::make_shared<const World>(balls(&make_orb));
  const auto foreign = std::make_shared<const World>(balls(&tests::foreign_ball));
  const auto disguised = std::make_shared<const World>(
      balls([](const std::string& name, double r) { return tests::disguised(make_orb(name, r)); }));
  Runtime a(own, {.jit = JitMode::off}), b(foreign, {.jit = JitMode::off}),
      c(disguised, {.jit = JitMode::off});
  Navigator x = a.navigator(), y = b.navigator(), z = c.navigator();
  std::size_t steps = 0;
  for (const Ray& ray : tests::rays_through(*own, 5, 20000)) {
    const auto right = without_slivers(tests::trace(x, ray, own->tolerance));
    for (Navigator* navigator : {&y, &z}) {
      const auto got = without_slivers(tests::trace(*navigator, ray, own->tolerance));
      ASSERT_EQ(got.size(), right.size());
      for (std::size_t i = 0; i < right.size(); ++i) {
        ASSERT_EQ(got[i].touchable, right[i].touchable);
        ASSERT_NEAR(got[i].length, right[i].length, 1e-7);
      }
    }
    const State s = x.locate(ray.position, ray.direction);
    ASSERT_EQ(y.locate(ray.position, ray.direction), s);
    steps += right.size();
    if (!s.inside()) continue;
    ASSERT_NEAR(y.safety(s, ray.position), x.safety(s, ray.position), 1e-9);
  }
  EXPECT_GT(steps, 20000U);
}

TEST(ForeignSolids, KeepTheirVolumesFromCompilersAndNothingElse) {
  const auto world = std::make_shared<const World>(balls(&tests::foreign_ball));
  Runtime runtime(world, eager(JitMode::wait));
  const auto rays = tests::rays_through(*world, 6, 4000);
  {
    Navigator navigator = runtime.navigator();
    for (const Ray& ray : rays) tests::trace(navigator, ray, world->tolerance);
  }
  runtime.wait_until_idle();
  EXPECT_EQ(tests::traces_that_differ(runtime, rays), 0U);
  bool compiled = false;
  for (const SceneReport& scene : runtime.report().scenes) {
    EXPECT_NE(scene.status, SceneStatus::failed) << scene.volume << ": " << scene.note;
    const bool has_code =
        scene.binding == Binding::constants || scene.binding == Binding::structure;
    if (scene.volume == "plate") {
      compiled = has_code;
    } else {
      EXPECT_FALSE(has_code) << scene.volume;
    }
  }
  EXPECT_TRUE(compiled) << "the plates are boxes";
}

TEST(ForeignSolids, AreAskedByManyThreads) {
  const auto world = std::make_shared<const World>(balls(&tests::foreign_ball));
  Runtime runtime(world, eager(JitMode::on));
  const auto rays = tests::rays_through(*world, 7, 1000);
  const auto length = [&] {
    Navigator navigator = runtime.navigator();
    double sum = 0;
    for (const Ray& ray : rays) {
      for (const Row& row : tests::trace(navigator, ray, world->tolerance)) sum += row.length;
    }
    return sum;
  };
  std::vector<double> sums(4);
  {
    std::vector<std::jthread> threads;
    for (double& sum : sums) threads.emplace_back([&] { sum = length(); });
  }
  for (const double sum : sums) EXPECT_EQ(sum, sums[0]);
}

TEST(ForeignSolids, HaveNoReferenceIn113Bits) {
  const auto world = std::make_shared<const World>(balls(&tests::foreign_ball));
  EXPECT_THROW(reference::WideGeometry{world}, GeometryError);
}

TEST(ForeignSolids, AreKnownByTheirKeys) {
  const auto fingerprint = [](double radius) {
    return geometry_fingerprint(
        Geometry(std::make_shared<const World>(balls([&](const std::string& name, double r) {
          return tests::foreign_ball(name, r == 5 ? radius : r);
        }))));
  };
  EXPECT_EQ(fingerprint(5), fingerprint(5));
  EXPECT_NE(fingerprint(5), fingerprint(4));
}

}  // namespace
}  // namespace navjit
