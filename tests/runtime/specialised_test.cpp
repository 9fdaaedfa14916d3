// Specialised navigators compared with generic ones, bit for bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <thread>
#include <vector>

#include "navjit/runtime.hpp"
#include "runtime/overrides.hpp"
#include "tests/support/traces.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

using tests::random_direction;
using tests::rays_through;
using tests::Row;
using tests::same_bits;
using tests::trace;
using tests::uniform;

RuntimeOptions options(JitMode jit) { return tests::eager_options(jit); }

/// `most_bail_outs` is a fraction of the steps. Many of the rays run along axes.
void expect_same_traces(const std::shared_ptr<const World>& world, std::uint64_t seed, int rays,
                        double most_bail_outs = 0.25) {
  Runtime generic(world, options(JitMode::off)), specialised(world, options(JitMode::wait));
  Navigator a = generic.navigator(), b = specialised.navigator();
  for (const Ray& ray : rays_through(*world, seed, rays)) {
    const auto right = trace(a, ray, world->tolerance), got = trace(b, ray, world->tolerance);
    ASSERT_TRUE(same_bits(right, got))
        << "ray from " << ray.position.x << ' ' << ray.position.y << ' ' << ray.position.z;
  }
  const RuntimeReport report = specialised.report();
  for (const SceneReport& scene : report.scenes) {
    EXPECT_NE(scene.status, SceneStatus::failed) << scene.volume << ": " << scene.note;
  }
  EXPECT_GT(tests::share_specialised(specialised), 0.5);
  EXPECT_LT(static_cast<double>(b.counts().bail_outs),
            most_bail_outs * static_cast<double>(report.steps));
}

TEST(Specialised, TracesTheMixedWorldAlike) {
  expect_same_traces(std::make_shared<const World>(tests::mixed_world()), 1, 4000);
}

TEST(Specialised, TracesRandomWorldsAlike) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    expect_same_traces(std::make_shared<const World>(tests::random_world(seed, 3)), seed, 1500);
  }
}

TEST(Specialised, TracesOverlapsAlike) {
  std::mt19937_64 random(5);
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 20, 20, 20));
  for (int i = 0; i < 12; ++i) {
    const std::string name = "v" + std::to_string(i);
    const VolumeId v = tests::add_volume(
        world, name, make_box(name, uniform(random, 2, 8), uniform(random, 2, 8), 5));
    // Overlapping each other and sticking out of the world.
    tests::place(world, world.top, v,
                 {uniform(random, -18, 18), uniform(random, -18, 18), uniform(random, -18, 18)},
                 {0, 0, i % 3 == 0 ? 0.0 : uniform(random, 0, 3)});
  }
  finish(world);
  expect_same_traces(std::make_shared<const World>(std::move(world)), 6, 3000);
}

/// A nest of shells, and rings of segments and of modules, with gaps, in no order. `overlap`:
/// shells and segments reach into one another, and one daughter sticks out of the mother.
World round_world(std::uint64_t seed, bool overlap) {
  std::mt19937_64 random(seed);
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 200, 100, 100));
  const auto about = [&](const char* name, double x) {
    const VolumeId v = tests::add_volume(world, name, make_tube(name, 0, 60, 60, 0, 7));
    tests::place(world, world.top, v, {x, 0, 0}, {0.3, 0, x});
    return v;
  };
  const double more = overlap ? 0.4 : 0;
  const VolumeId nest = about("nest", -130), disk = about("disk", 0), barrel = about("barrel", 130);
  for (int i = 0; i < 9; ++i) {
    const std::string name = "shell" + std::to_string(i);
    const VolumeId shell = tests::add_volume(
        world, name, make_tube(name, 5 + 6 * i, 9 + 6 * i + 6 * more + 2 * (i % 2), 40 + i, 0, 7));
    tests::place(world, nest, shell, {0, 0, overlap && i == 8 ? 15.0 : 0});
  }
  for (int i = 0; i < 24; ++i) {
    const std::string name = std::to_string(i);
    const double step = M_PI / 12;
    const VolumeId petal = tests::add_volume(
        world, "petal" + name, make_tube("p" + name, 20, 50, 4, 0, step * (1 + more)));
    tests::place(world, disk, petal, {0, 0, i % 2 == 0 ? 5.0 : -5.0}, {0, 0, -step * i});
    if (i == 5) continue;
    const VolumeId module =
        tests::add_volume(world, "module" + name, make_box("m" + name, 3, overlap ? 7 : 4.8, 30));
    tests::place(world, barrel, module, {40 * std::cos(step * i), 40 * std::sin(step * i), 0},
                 {0, 0, -step * i});
  }
  for (const VolumeId v : {nest, disk, barrel}) {
    std::shuffle(world.volumes[v].daughters.begin(), world.volumes[v].daughters.end(), random);
  }
  finish(world);
  return world;
}

TEST(Specialised, TracesNestsAndRingsAlike) {
  for (const char* forced : {"", "*=nest", "*=rings", "*=boxes"}) {
    for (const bool overlap : {false, true}) {
      SCOPED_TRACE(std::string(forced) + (overlap ? ", overlapping" : ""));
      setenv(overrides_variable, forced, 1);
      expect_same_traces(std::make_shared<const World>(round_world(3, overlap)), 17, 500);
      unsetenv(overrides_variable);
    }
  }
}

/// Shells about an axis or a centre, some tenths of a millimetre in radius, in a hall of
/// kilometres.
World small_shells(bool about_centre) {
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 1e7, 1e7, 1e7));
  for (int i = 0; i < 6; ++i) {
    const std::string name = "shell" + std::to_string(i);
    const double inner = 0.1 + 0.2 * i, outer = inner + 0.1;
    const VolumeId shell =
        tests::add_volume(world, name,
                          about_centre ? make_sphere(name, inner, outer, 0, 2 * M_PI, 0, M_PI)
                                       : make_tube(name, inner, outer, 1e6, 0, 2 * M_PI));
    tests::place(world, world.top, shell, {0, 0, 0});
  }
  finish(world);
  return world;
}

TEST(Specialised, TracesSmallNestsFromFarAwayAlike) {
  setenv(overrides_variable, "*=nest", 1);
  for (const bool about_centre : {false, true}) {
    SCOPED_TRACE(about_centre ? "spheres" : "tubes");
    const auto world = std::make_shared<const World>(small_shells(about_centre));
    std::mt19937_64 random(23);
    std::vector<Ray> rays;
    for (int i = 0; i < 3000; ++i) {
      const Vec3 from = uniform(random, 1e3, 1e7) * random_direction(random);
      const auto near = [&] { return uniform(random, -2, 2); };
      const double x = near(), y = near(), z = near();
      Vec3 v = Vec3{x, y, z} - from;
      v = (1 / norm(v)) * v;
      rays.push_back({from, v});
    }
    Runtime specialised(world, options(JitMode::wait));
    EXPECT_EQ(tests::traces_that_differ(specialised, rays), 0U);
    EXPECT_GT(tests::share_specialised(specialised), 0.5);
  }
  unsetenv(overrides_variable);
}

/// Blades that are inclined to the radius, in two rings with opposite inclinations.
World blades() {
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 100, 100, 60));
  const VolumeId bath = tests::add_volume(world, "bath", make_tube("bath", 0, 90, 55, 0, 7));
  tests::place(world, world.top, bath, {0, 0, 0});
  const VolumeId blade = tests::add_volume(world, "blade", make_box("blade", 9, 0.2, 50));
  const VolumeId foil = tests::add_volume(world, "foil", make_box("foil", 8, 0.05, 49));
  tests::place(world, blade, foil, {0, 0, 0});
  for (const double lean : {0.8, -0.7}) {
    const double radius = lean > 0 ? 40 : 70;
    for (int i = 0; i < 100; ++i) {
      const double phi = 2 * M_PI / 100 * i;
      tests::place(world, bath, blade, {radius * std::cos(phi), radius * std::sin(phi), 0},
                   {0, 0, -(phi + lean)});
    }
  }
  finish(world);
  return world;
}

TEST(Specialised, TracesLeaningBladesAlike) {
  for (const char* forced : {"", "*=rings"}) {
    SCOPED_TRACE(forced);
    setenv(overrides_variable, forced, 1);
    expect_same_traces(std::make_shared<const World>(blades()), 19, 1500);
    unsetenv(overrides_variable);
  }
}

/// A few wide blades, each of which has much of a turn to itself, and leans so far that it nearly
/// lies along its ring.
World wide_blades(int count, double lean) {
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 130, 130, 60));
  const VolumeId bath = tests::add_volume(world, "bath", make_tube("bath", 0, 120, 55, 0, 7));
  tests::place(world, world.top, bath, {0, 0, 0});
  const VolumeId blade = tests::add_volume(world, "blade", make_box("blade", 20, 1, 50));
  for (int i = 0; i < count; ++i) {
    const double phi = 2 * M_PI / count * i;
    tests::place(world, bath, blade, {80 * std::cos(phi), 80 * std::sin(phi), 0},
                 {0, 0, -(phi + lean)});
  }
  finish(world);
  return world;
}

TEST(Specialised, TracesAFewWideBladesAlike) {
  setenv(overrides_variable, "*=rings", 1);
  for (const int count : {4, 6, 9, 12}) {
    for (const double lean : {1.4, 1.0, -1.0, -1.4}) {
      SCOPED_TRACE(std::to_string(count) + " blades that lean by " + std::to_string(lean));
      expect_same_traces(std::make_shared<const World>(wide_blades(count, lean)), 19, 400);
    }
  }
  unsetenv(overrides_variable);
}

/// Everything is in one frame, turned by right angles about each axis in turn and both ways, and at
/// coordinates of both signs: entries of -1 and 1 meet negative numbers wherever text is put
/// together.
TEST(Specialised, TracesTurnsByRightAnglesAlike) {
  for (int turn = 0; turn < 6; ++turn) {
    SCOPED_TRACE("turn " + std::to_string(turn));
    const double angle = turn % 2 == 0 ? M_PI / 2 : -M_PI;
    Vec3 angles{0, 0, 0};
    (turn / 2 == 0 ? angles.x : turn / 2 == 1 ? angles.y : angles.z) = angle;
    World world;
    world.top = tests::add_volume(world, "world", make_box("world", 50, 50, 50));
    const VolumeId hall = tests::add_volume(world, "hall", make_box("hall", 30, 30, 30));
    const VolumeId bar = tests::add_volume(world, "bar", make_box("bar", 2, 3, 4));
    const VolumeId wire = tests::add_volume(world, "wire", make_tube("wire", 0, 1, 1, 0, 7));
    const VolumeId pin = tests::add_volume(world, "pin", make_tube("pin", 0, 1, 2, 0, 7));
    tests::place(world, world.top, hall, {-3, -5, -7}, angles);
    // One axis along which all daughters have the same negative coordinate, and two with both
    // signs.
    for (int i = 0; i < 4; ++i) {
      tests::place(world, hall, bar, {-20.0 + 10 * i, -8, i % 2 == 0 ? -9.0 : 9.0});
      tests::place(world, hall, pin, {-20.0 + 10 * i, -8, i % 2 == 0 ? 9.0 : -9.0}, angles);
    }
    tests::place(world, bar, wire, {-0.5, -1.5, -2});
    finish(world);
    expect_same_traces(std::make_shared<const World>(std::move(world)), 19, 400);
  }
}

/// Stacks of plates of three thicknesses and rods of two, turned by the given angles; with
/// `two_mothers` some of the leaves are in another volume as well.
World stacks_of_leaves(const std::vector<Vec3>& turns, bool two_mothers) {
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 300, 100, 100));
  const VolumeId stack = tests::add_volume(world, "stack", make_box("stack", 40, 30, 30));
  VolumeId leaves[5];
  for (int i = 0; i < 3; ++i) {
    const std::string name = "plate" + std::to_string(i);
    leaves[i] = tests::add_volume(world, name, make_box(name, 1 + i, 20 + i, 25));
  }
  for (int i = 0; i < 2; ++i) {
    const std::string name = "rod" + std::to_string(i);
    leaves[3 + i] = tests::add_volume(world, name, make_tube(name, 0, 2 + i, 25 - i, 0, 7));
  }
  double x = -40;
  for (int k = 0; k < 8; ++k) {
    const int i = k % 5;
    const double half = i < 3 ? 1 + i : i - 1;
    tests::place(world, stack, leaves[i], {x + half, 0, 0});
    x += 2 * half + (k % 2);
  }
  double at = -200;
  for (const Vec3& turn : turns) tests::place(world, world.top, stack, {at += 100, 0, 0}, turn);
  if (two_mothers) {
    const VolumeId crate = tests::add_volume(world, "crate", make_box("crate", 30, 30, 30));
    tests::place(world, crate, leaves[0], {-10, 0, 0});
    tests::place(world, crate, leaves[2], {10, 0, 0});
    tests::place(world, world.top, crate, {200, 0, 0});
  }
  finish(world);
  return world;
}

TEST(Specialised, TracesLeavesThatShareCodeAlike) {
  const Vec3 straight{0, 0, 0}, turned{0.3, -0.4, 0.5}, other{0.1, 0.7, -0.2};
  for (const std::vector<Vec3>& turns :
       {std::vector<Vec3>{straight, straight}, {turned, turned}, {straight, turned, other}}) {
    for (const bool two_mothers : {false, true}) {
      SCOPED_TRACE(std::to_string(turns.size()) + (two_mothers ? ", two mothers" : ""));
      expect_same_traces(std::make_shared<const World>(stacks_of_leaves(turns, two_mothers)), 23,
                         800, 0.4);
    }
  }
}

TEST(Specialised, SwapsDoNotChangeARunningTransport) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  Runtime generic(world, options(JitMode::off)), swapping(world, options(JitMode::on));
  const std::vector<Ray> rays = rays_through(*world, 9, 400);
  std::vector<std::vector<Row>> right;
  Navigator a = generic.navigator();
  for (const Ray& ray : rays) right.push_back(trace(a, ray, world->tolerance));
  std::vector<std::jthread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] {
      Navigator b = swapping.navigator();
      // Until all has been swapped that will be, and once more; however slow the compiler is.
      for (int left = 2, pass = 0; left > 0 && pass < 100000; ++pass) {
        if (tests::scenes_compiled(swapping) >= 3) --left;
        for (std::size_t i = 0; i < rays.size(); ++i) {
          ASSERT_TRUE(same_bits(right[i], trace(b, rays[i], world->tolerance)));
        }
      }
    });
  }
  threads.clear();
  swapping.wait_until_idle();
  Navigator b = swapping.navigator();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ASSERT_TRUE(same_bits(right[i], trace(b, rays[i], world->tolerance)));
  }
  EXPECT_GE(tests::scenes_compiled(swapping), 3U);
}

/// Traces rays; in the middle of each, waits for what is due to be specialised. Returns how often
/// something was specialised, and counts rays that differ from the generic ones.
int swaps_within_rays(const FaultyOptions& with, std::size_t& differing) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  Runtime generic(world, options(JitMode::off));
  FaultyRuntime swapping(world, with);
  Navigator a = generic.navigator(), b = swapping.navigator();
  int swaps = 0;
  for (const Ray& ray : rays_through(*world, 21, 400)) {
    const std::vector<Row> right = trace(a, ray, world->tolerance);
    std::vector<Row> rows;
    transport(b, ray, world->tolerance, [&](const State& state, double length) {
      rows.push_back({state.touchable(), length, state.volume()});
      if (rows.size() != right.size() / 2) return;
      const std::size_t before = tests::scenes_compiled(swapping);
      swapping.wait_until_idle();
      swaps += tests::scenes_compiled(swapping) > before ? 1 : 0;
    });
    differing += same_bits(right, rows) ? 0 : 1;
  }
  EXPECT_GT(tests::share_specialised(swapping), 0.5);
  return swaps;
}

TEST(Specialised, SwapsWithinARayDoNotChangeIt) {
  FaultyOptions with{options(JitMode::on)};
  with.specialiser.batch = 1;  // many swaps rather than one
  std::size_t differing = 0;
  EXPECT_GE(swaps_within_rays(with, differing), 3);
  EXPECT_EQ(differing, 0U);
  with.faults = tests::wrong_code();
  EXPECT_GE(swaps_within_rays(with, differing), 3);
  EXPECT_GT(differing, 50U) << "nothing would be noticed";
}

/// The differences that shadow mode counts; the answers have to be the generic ones nevertheless.
std::uint64_t differences_in_shadow(std::shared_ptr<const Faults> faults) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  FaultyOptions with{options(JitMode::shadow)};
  with.faults = std::move(faults);
  Runtime generic(world, options(JitMode::off));
  FaultyRuntime runtime(world, with);
  Navigator a = generic.navigator(), b = runtime.navigator();
  for (int pass = 0; pass < 5; ++pass) {
    for (const Ray& ray : rays_through(*world, 11, 400)) {
      EXPECT_TRUE(same_bits(trace(a, ray, world->tolerance), trace(b, ray, world->tolerance)));
    }
    runtime.wait_until_idle();
  }
  EXPECT_GE(tests::scenes_compiled(runtime), 3U);
  EXPECT_GT(tests::share_specialised(runtime), 0.5);
  return b.counts().differences;
}

TEST(Specialised, ShadowModeCountsNoDifferences) { EXPECT_EQ(differences_in_shadow(nullptr), 0U); }

TEST(Specialised, ShadowModeCountsDifferencesAndMendsThem) {
  EXPECT_GT(differences_in_shadow(tests::wrong_code()), 1000U);
}

/// A scene whose specialisation fails stays generic, and only the report shows it.
void expect_generic_after(const std::function<void(FaultyOptions&)>& spoil) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  FaultyOptions spoilt{options(JitMode::wait)};
  spoil(spoilt);
  Runtime generic(world, options(JitMode::off));
  FaultyRuntime runtime(world, spoilt);
  Navigator a = generic.navigator(), b = runtime.navigator();
  for (const Ray& ray : rays_through(*world, 13, 300)) {
    ASSERT_TRUE(same_bits(trace(a, ray, world->tolerance), trace(b, ray, world->tolerance)));
  }
  std::size_t failed = 0;
  for (const SceneReport& s : runtime.report().scenes) {
    EXPECT_NE(s.status, SceneStatus::specialised) << s.volume;
    if (s.status == SceneStatus::failed) {
      ++failed;
      EXPECT_FALSE(s.note.empty());
    }
  }
  EXPECT_GT(failed, 0U);
}

TEST(Faults, ACompilerErrorLeavesScenesGeneric) {
  expect_generic_after([](FaultyOptions& o) {
    o.faults = tests::edited([](std::string& source) { source += "\nint broken = ;\n"; });
  });
}

TEST(Faults, AFailedVerificationLeavesScenesGeneric) {
  expect_generic_after([](FaultyOptions& o) {
    o.faults = std::make_shared<Faults>(Faults{.fail_verification = true});
  });
}

TEST(Faults, WrongCodeIsFoundByVerification) {
  expect_generic_after([](FaultyOptions& o) {
    Faults faults = *tests::wrong_code();
    faults.skip_verification = false;
    o.faults = std::make_shared<Faults>(faults);
  });
}

TEST(Faults, OneBadSceneDoesNotSpoilTheOthers) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  FaultyOptions o{options(JitMode::wait)};
  o.faults = tests::edited([](std::string& source) {
    if (source.find("navjit_step_2_") != std::string::npos) source += "\nint broken = ;\n";
  });
  FaultyRuntime runtime(world, o);
  Navigator navigator = runtime.navigator();
  for (const Ray& ray : rays_through(*world, 15, 2000)) trace(navigator, ray, world->tolerance);
  const RuntimeReport report = runtime.report();
  // All but the stack, which its plates and tiles fill.
  EXPECT_EQ(report.scenes.size(), world->volumes.size() - 1);
  for (const SceneReport& s : report.scenes) {
    EXPECT_EQ(s.status, s.volume_id == 2 ? SceneStatus::failed : SceneStatus::specialised)
        << s.volume << ": " << s.note;
  }
}

}  // namespace
}  // namespace navjit
