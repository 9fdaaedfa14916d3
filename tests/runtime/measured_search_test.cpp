// If the run measured that another search is faster than the one that the analysis chose, code uses
// the other one, and so does the code of the next run.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>
#include <thread>

#include "runtime/faulty_runtime.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/traces.hpp"

namespace navjit {
namespace {

/// All sources that are compiled.
struct Sources {
  std::mutex mutex;
  std::string text;
};

FaultyOptions options_with(const std::string& cache, std::optional<Candidates> fastest,
                           const std::shared_ptr<Sources>& sources) {
  FaultyOptions options{tests::eager_options(JitMode::on)};
  options.cache = Cache::in(cache);
  options.specialiser.min_steps = 5000;  // scenes are bound to data before
  const auto faults = std::make_shared<Faults>();
  faults->fastest = fastest;
  faults->skip_replay = true;
  faults->edit_source = [sources](std::string& source) {
    const std::lock_guard lock(sources->mutex);
    sources->text += source;
  };
  options.faults = faults;
  return options;
}

void expect_right(Runtime& runtime) {
  Runtime generic(runtime.share_world(), tests::eager_options(JitMode::off));
  Navigator a = generic.navigator(), b = runtime.navigator();
  for (const Ray& ray : tests::rays_through(runtime.world(), 3, 1500)) {
    const double tolerance = runtime.world().tolerance;
    ASSERT_TRUE(tests::same_bits(tests::trace(a, ray, tolerance), tests::trace(b, ray, tolerance)));
  }
}

std::size_t specialised(const Runtime& runtime) {
  std::size_t count = 0;
  for (const SceneReport& scene : runtime.report().scenes) {
    count += scene.status == SceneStatus::specialised ? 1 : 0;
  }
  return count;
}

/// Plates that fill their mother: the analysis chooses slabs.
std::shared_ptr<const World> plates() {
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 40, 40, 30));
  const VolumeId plate = tests::add_volume(world, "plate", make_box("plate", 40, 40, 1.5));
  for (int i = 0; i < 12; ++i) tests::place(world, world.top, plate, {0, 0, 5.0 * i - 27.5});
  finish(world);
  return std::make_shared<const World>(std::move(world));
}

TEST(MeasuredSearch, IsThatOfTheCode) {
  for (const auto& [fastest, scans] :
       {std::pair(Candidates::slabs, false), {Candidates::scan, true}, {Candidates::tree, false}}) {
    SCOPED_TRACE(static_cast<int>(fastest));
    const tests::TemporaryFolder folder;
    const auto sources = std::make_shared<Sources>();
    FaultyRuntime runtime(plates(), options_with(folder.path(), fastest, sources));
    for (int pass = 0; pass < 3; ++pass) {
      expect_right(runtime);
      runtime.wait_until_idle();
    }
    EXPECT_EQ(specialised(runtime), 2U);
    EXPECT_EQ(sources->text.find("constexpr SearchScan ") != std::string::npos, scans);
  }
}

/// Thin blades about an axis, whose boxes overlap: the analysis leaves them to boxes.
std::shared_ptr<const World> blades() {
  World world;
  world.top = tests::add_volume(world, "world", make_tube("world", 40, 200, 60, 0, 7));
  const VolumeId blade = tests::add_volume(world, "blade", make_box("blade", 60, 0.4, 50));
  constexpr int count = 96;
  for (int i = 0; i < count; ++i) {
    const double phi = 2 * M_PI * i / count;
    tests::place(world, world.top, blade, {120 * std::cos(phi), 120 * std::sin(phi), 0},
                 {0, 0, -phi});
  }
  finish(world);
  return std::make_shared<const World>(std::move(world));
}

TEST(MeasuredSearch, MayBeByTheSectorsOfARing) {
  for (const Candidates fastest : {Candidates::rings, Candidates::tree}) {
    const tests::TemporaryFolder folder;
    const auto sources = std::make_shared<Sources>();
    FaultyRuntime runtime(blades(), options_with(folder.path(), fastest, sources));
    for (int pass = 0; pass < 4; ++pass) {
      expect_right(runtime);
      runtime.wait_until_idle();
    }
    EXPECT_GE(specialised(runtime), 1U);
    EXPECT_EQ(sources->text.find("constexpr SearchRings<") != std::string::npos,
              fastest == Candidates::rings);
  }
}

/// Three shells, each of which is also a ring: the analysis writes them out one by one.
std::shared_ptr<const World> shells() {
  World world;
  world.top = tests::add_volume(world, "world", make_tube("world", 0, 200, 60, 0, 7));
  for (const double r : {50.0, 100.0, 150.0}) {
    const std::string name = "shell" + std::to_string(static_cast<int>(r));
    const VolumeId shell = tests::add_volume(world, name, make_tube(name, r, r + 10, 50, 0, 7));
    tests::place(world, world.top, shell, {0, 0, 0});
  }
  finish(world);
  return std::make_shared<const World>(std::move(world));
}

TEST(MeasuredSearch, IsNotThatOfCodeThatSpellsOutEveryDaughter) {
  for (const Candidates fastest : {Candidates::scan, Candidates::rings}) {
    const tests::TemporaryFolder folder;
    const auto sources = std::make_shared<Sources>();
    FaultyRuntime runtime(shells(), options_with(folder.path(), fastest, sources));
    for (int pass = 0; pass < 4; ++pass) {
      expect_right(runtime);
      runtime.wait_until_idle();
    }
    EXPECT_GE(specialised(runtime), 1U);
    EXPECT_NE(sources->text, "");
    EXPECT_EQ(sources->text.find("constexpr SearchScan "), std::string::npos);
    EXPECT_EQ(sources->text.find("constexpr SearchRings<"), std::string::npos);
  }
}

/// A run in which nothing becomes hot by itself, with the cache of another one.
FaultyOptions patient_options(const std::string& cache, const std::shared_ptr<Sources>& sources) {
  FaultyOptions options = options_with(cache, {}, sources);
  options.specialiser.min_steps = 1'000'000'000;
  return options;
}

/// Expects that such a run has so many specialised scenes at once, all from the cache.
void expect_found_again(const std::shared_ptr<const World>& world, const std::string& cache,
                        std::size_t hot) {
  const auto sources = std::make_shared<Sources>();
  FaultyRuntime second(world, patient_options(cache, sources));
  second.wait_until_idle();
  expect_right(second);
  EXPECT_EQ(specialised(second), hot);
  EXPECT_EQ(sources->text, "") << "all of it is in the cache";
}

TEST(MeasuredSearch, IsRememberedByTheNextRun) {
  const std::shared_ptr<const World> world = plates();
  const tests::TemporaryFolder folder;
  const auto sources = std::make_shared<Sources>();
  std::size_t hot = 0;
  {
    FaultyRuntime first(world, options_with(folder.path(), Candidates::scan, sources));
    for (int pass = 0; pass < 3; ++pass) {
      expect_right(first);
      first.wait_until_idle();
    }
    hot = specialised(first);
    ASSERT_EQ(hot, 2U);
    ASSERT_NE(sources->text.find("constexpr SearchScan "), std::string::npos);
  }
  expect_found_again(world, folder.path(), hot);
}

/// The plates again, and beside them a small stack that few rays meet.
std::shared_ptr<const World> plates_and_a_stack() {
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 60, 40, 30));
  const VolumeId plate = tests::add_volume(world, "plate", make_box("plate", 40, 40, 1.5));
  for (int i = 0; i < 12; ++i) tests::place(world, world.top, plate, {-20, 0, 5.0 * i - 27.5});
  const VolumeId stack = tests::add_volume(world, "stack", make_box("stack", 12, 12, 12));
  tests::place(world, world.top, stack, {45, 0, 0});
  const VolumeId sheet = tests::add_volume(world, "sheet", make_box("sheet", 12, 12, 0.5));
  for (int i = 0; i < 12; ++i) tests::place(world, stack, sheet, {0, 0, 2.0 * i - 11});
  finish(world);
  return std::make_shared<const World>(std::move(world));
}

TEST(MeasuredSearch, IsRememberedOfScenesThatOnlyOtherCodeContains) {
  // The stack has a measured search, and no code of its own: the world's code contains the search.
  const std::shared_ptr<const World> world = plates_and_a_stack();
  const tests::TemporaryFolder folder;
  const auto sources = std::make_shared<Sources>();
  std::size_t hot = 0;
  {
    FaultyRuntime first(world, options_with(folder.path(), Candidates::scan, sources));
    for (int pass = 0; pass < 3; ++pass) {
      expect_right(first);
      first.wait_until_idle();
    }
    const RuntimeReport report = first.report();
    const auto stack = std::find_if(report.scenes.begin(), report.scenes.end(),
                                    [](const SceneReport& s) { return s.volume == "stack"; });
    ASSERT_NE(stack, report.scenes.end());
    ASSERT_EQ(stack->binding, Binding::data) << stack->steps << " steps";
    hot = specialised(first);
    ASSERT_GE(hot, 1U);
  }
  expect_found_again(world, folder.path(), hot);
}

/// Rays upwards, from x in this range.
void shoot(Runtime& runtime, double from, double to, int rays) {
  Navigator navigator = runtime.navigator();
  for (int i = 0; i < rays; ++i) {
    const Vec3 v{0.001, 0.002, 1}, start{from + (to - from) * (i % 97) / 97, 0.1 * (i % 7), -29.9};
    tests::trace(navigator, Ray{start, (1 / norm(v)) * v}, runtime.world().tolerance);
  }
}

TEST(MeasuredSearch, IsListedAsTheCodeHasIt) {
  // While the world's code is compiled, the stack gets a measured search, which that code does not
  // have.
  const std::shared_ptr<const World> world = plates_and_a_stack();
  const tests::TemporaryFolder folder;
  const auto sources = std::make_shared<Sources>();
  std::size_t modules = 0;
  {
    FaultyOptions options = options_with(folder.path(), Candidates::scan, sources);
    const auto faults = std::make_shared<Faults>(*options.faults);
    std::atomic<bool> compiling{false}, go_on{false};
    faults->compiling = [&] {
      if (compiling.exchange(true)) return;
      for (int i = 0; i < 4000 && !go_on; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      }
    };
    options.faults = faults;
    FaultyRuntime first(world, options);
    for (int i = 0; i < 400 && !compiling; ++i) shoot(first, -55, 15, 500);
    ASSERT_TRUE(compiling);
    bool bound = false;
    for (int i = 0; i < 1000 && !bound; ++i) {
      shoot(first, 35, 55, 20);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      for (const SceneReport& scene : first.report().scenes) {
        bound = bound || (scene.volume == "stack" && scene.binding == Binding::data);
      }
    }
    EXPECT_TRUE(bound);
    go_on = true;
    first.wait_until_idle();
    modules = first.report().modules;
    ASSERT_GE(modules, 1U);
  }
  FaultyRuntime second(world, patient_options(folder.path(), sources));
  second.wait_until_idle();
  EXPECT_EQ(second.report().cached_modules, modules);
}

}  // namespace
}  // namespace navjit
