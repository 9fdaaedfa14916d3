// Scenes bound to structures, compared with the generic navigator bit for bit.
#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

#include "analysis/plan.hpp"
#include "codegen/structure.hpp"
#include "geometry/gdml/read_world.hpp"
#include "navjit/runtime.hpp"
#include "runtime/faulty_runtime.hpp"
#include "tests/support/traces.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

RuntimeOptions without_constants(JitMode jit) {
  RuntimeOptions options = tests::eager_options(jit);
  options.specialiser.constants = false;
  options.specialiser.keep_only_faster = false;
  return options;
}

/// The fraction of steps made by code of a structure; all answers have to be the generic ones.
double share_by_structures(const std::shared_ptr<const World>& world, int rays) {
  Runtime generic(world, without_constants(JitMode::off));
  Runtime bound(world, without_constants(JitMode::wait));
  Navigator a = generic.navigator(), b = bound.navigator();
  std::mt19937_64 random(1);
  for (const Ray& ray : tests::rays_through(*world, 5, rays)) {
    EXPECT_TRUE(tests::same_bits(tests::trace(a, ray, world->tolerance),
                                 tests::trace(b, ray, world->tolerance)));
    Vec3 p = ray.position;
    State s = a.locate(p, ray.direction);
    for (int i = 0; i < 6 && s.inside(); ++i) {
      const double safety = a.safety(s, p), bound_safety = b.safety(s, p);
      EXPECT_TRUE(kernels::same_bits(safety, bound_safety)) << safety;
      const Vec3 v = tests::random_direction(random);
      const double limit = tests::uniform(random, 0, 30);
      const Step one = a.step(s, p, v, limit), other = b.step(s, p, v, limit);
      EXPECT_TRUE(kernels::same_bits(one.length, other.length));
      EXPECT_EQ(one.next, other.next);
      p = p + one.length * v;
      s = one.next;
    }
  }
  double all = 0, by_structure = 0;
  for (const SceneReport& scene : bound.report().scenes) {
    EXPECT_NE(scene.status, SceneStatus::failed) << scene.volume << ": " << scene.note;
    EXPECT_NE(scene.binding, Binding::constants);
    all += static_cast<double>(scene.steps);
    if (scene.binding == Binding::structure) by_structure += static_cast<double>(scene.steps);
  }
  return by_structure / all;
}

TEST(BoundToStructure, MixedWorldAlike) {
  EXPECT_GT(share_by_structures(std::make_shared<const World>(tests::mixed_world()), 600), 0.1);
}

TEST(BoundToStructure, RandomWorldsAlike) {
  for (const std::uint64_t seed : {1, 2}) {
    const auto world = std::make_shared<const World>(tests::random_world(seed, 3));
    EXPECT_GT(share_by_structures(world, 300), 0.1);
  }
}

TEST(BoundToStructure, ShippedDetectorsAlike) {
  for (const char* file : {"/shashlik.gdml", "/barrel.gdml"}) {
    SCOPED_TRACE(file);
    share_by_structures(
        std::make_shared<const World>(read_world(std::string(NAVJIT_DETECTORS_DIR) + file)), 200);
  }
}

/// Modules of structures that a run which waits for them has, of which the first `broken` do not
/// compile.
std::size_t structures_with(int broken, double wait_ms) {
  const auto world =
      std::make_shared<const World>(read_world(std::string(NAVJIT_DETECTORS_DIR) + "/barrel.gdml"));
  FaultyOptions options{without_constants(JitMode::wait)};
  options.specialiser.solids = false;
  options.specialiser.wait_ms = wait_ms;
  const auto compilations = std::make_shared<std::atomic<int>>(0);
  options.faults = std::make_shared<const Faults>(Faults{.compiling = [=] {
    if (compilations->fetch_add(1) < broken) throw std::runtime_error("made to fail");
  }});
  return FaultyRuntime(world, options).report().modules;
}

TEST(BoundToStructure, OneThatDoesNotCompileIsNoReasonToStop) {
  const std::size_t all = structures_with(0, 6000);
  ASSERT_GE(all, 2U);
  EXPECT_EQ(structures_with(1, 6000), all - 1);
}

TEST(BoundToStructure, WrongCodeIsFoundAndNotUsed) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  FaultyOptions options{without_constants(JitMode::wait)};
  options.specialiser.solids = false;
  Faults faults = *tests::wrong_code();
  faults.skip_verification = false;
  options.faults = std::make_shared<const Faults>(faults);
  FaultyRuntime runtime(world, options);
  EXPECT_EQ(tests::traces_that_differ(runtime, tests::rays_through(*world, 7, 300)), 0U);
  std::size_t failed = 0;
  for (const SceneReport& scene : runtime.report().scenes) {
    EXPECT_NE(scene.binding, Binding::structure) << scene.volume;
    failed += scene.status == SceneStatus::failed ? 1 : 0;
  }
  EXPECT_GT(failed, 0U);
}

TEST(BoundToStructure, AreCompiledNoLongerThanARunWaits) {
  EXPECT_EQ(structures_with(0, 0), 0U);
  EXPECT_LT(structures_with(0, 100), structures_with(0, 1e6)) << "each takes some 100 ms";
}

TEST(BoundToStructure, ScenesOfOneStructureHaveOneSource) {
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 100, 100, 100));
  std::vector<VolumeId> mothers;
  for (const double size : {5.0, 7.0}) {
    const std::string name = std::to_string(size);
    const VolumeId core =
        tests::add_volume(world, "core" + name,
                          make_subtraction("core", make_box("b", size / 4, size / 4, size / 4),
                                           make_tube("t", 0, size / 9, 9, 0, 7)));
    mothers.push_back(tests::add_volume(world, "mother" + name, make_box("m", size, size, size)));
    tests::place(world, mothers.back(), core, {size / 3, 0, 0});
    tests::place(world, world.top, mothers.back(), {8 * size, 0, 0});
  }
  finish(world);
  const Geometry geometry(std::make_shared<const World>(std::move(world)));
  const WorldFacts facts = analyse_world(geometry);
  const auto module = [&](VolumeId v) {
    const ScenePlan plan = plan_scene(geometry, facts, v);
    EXPECT_TRUE(codegen::gains_from_structure(geometry, plan));
    return codegen::generate_structure(geometry, facts, plan);
  };
  const codegen::Module a = module(mothers[0]), b = module(mothers[1]);
  EXPECT_EQ(a.source, b.source);
  EXPECT_NE(a.data, b.data);
}

}  // namespace
}  // namespace navjit
