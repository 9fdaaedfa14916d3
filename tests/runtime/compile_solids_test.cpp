// Solids that are compiled for all scenes that hold them, compared with the generic navigator, bit
// for bit.
#include <gtest/gtest.h>

#include <array>
#include <mutex>

#include "analysis/plan.hpp"
#include "codegen/data/bind.hpp"
#include "codegen/solids.hpp"
#include "geometry/navigation/generic.hpp"
#include "geometry/navigation/steps_of_no_length.hpp"
#include "navjit/runtime.hpp"
#include "runtime/states.hpp"
#include "runtime/verify.hpp"
#include "runtime/verify_solid.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/random_solids.hpp"
#include "tests/support/traces.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

/// A frame of bars with a hole, turned or not, as in walls and cryostats.
Solid beam(double size) {
  const double r[9] = {0, 1, 0, -1, 0, 0, 0, 0, 1};
  SolidFrame up, turned;
  up.translation[2] = size;
  turned.translation[2] = -size;
  std::copy_n(r, 9, turned.rotation);
  const Solid bar = make_subtraction("bar", make_box("b", size, size / 4, size / 4),
                                     make_tube("hole", 0, size / 9, size, 0, 7));
  const Solid core = make_box("core", size / 5, size / 5, 2 * size);
  return make_union("beam", make_union("two", core, make_placed("up", bar, up)),
                    make_placed("turned", bar, turned));
}

/// Beams of two sizes in two halls; each hall holds one more kind of leaf.
std::shared_ptr<const World> halls() {
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 300, 300, 300));
  const VolumeId small = tests::add_volume(world, "small", beam(8));
  const VolumeId large = tests::add_volume(world, "large", beam(12));
  for (const double side : {-1.0, 1.0}) {
    const VolumeId hall = tests::add_volume(world, side < 0 ? "hall" : "other hall",
                                            make_box("hall", 90 + side, 90, 90));
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) {
        tests::place(world, hall, (i + j) % 3 == 0 ? large : small,
                     {-60.0 + 40 * i, -60.0 + 40 * j, 3.0 * (i - j)});
      }
    }
    tests::place(world, world.top, hall, {120 * side, 0, 0});
  }
  finish(world);
  return std::make_shared<const World>(std::move(world));
}

RuntimeOptions solids_alone(JitMode jit) {
  RuntimeOptions options = tests::eager_options(jit);
  options.specialiser.constants = options.specialiser.structures = false;
  return options;
}

std::size_t scenes_with_compiled_solids(const RuntimeReport& report) {
  std::size_t scenes = 0;
  for (const SceneReport& scene : report.scenes) {
    EXPECT_TRUE(scene.compiled_solids == 0 || scene.binding == Binding::data) << scene.volume;
    scenes += scene.compiled_solids > 0 ? 1 : 0;
  }
  return scenes;
}

TEST(CompiledSolids, AnswerAsTheGenericNavigator) {
  const auto world = halls();
  Runtime generic(world, {.jit = JitMode::off}), bound(world, solids_alone(JitMode::wait));
  Navigator a = generic.navigator(), b = bound.navigator();
  std::mt19937_64 random(3);
  for (const Ray& ray : tests::rays_through(*world, 4, 3000)) {
    ASSERT_TRUE(tests::same_bits(tests::trace(a, ray, world->tolerance),
                                 tests::trace(b, ray, world->tolerance)));
    Vec3 p = ray.position;
    State s = a.locate(p, ray.direction);
    for (int i = 0; i < 6 && s.inside(); ++i) {
      ASSERT_TRUE(kernels::same_bits(a.safety(s, p), b.safety(s, p)));
      const Vec3 v = tests::random_direction(random);
      const double limit = tests::uniform(random, 0, 30);
      const Step one = a.step(s, p, v, limit), other = b.step(s, p, v, limit);
      ASSERT_TRUE(kernels::same_bits(one.length, other.length));
      ASSERT_EQ(one.next, other.next);
      p = p + one.length * v;
      s = one.next;
    }
  }
  // Both halls and both beams: all but the world, which holds boxes.
  EXPECT_EQ(scenes_with_compiled_solids(bound.report()), 4U);
  EXPECT_GE(bound.report().modules, 1U);
}

/// A boolean of so many solids, some of which need much code.
Solid random_boolean(std::mt19937_64& random, int solids) {
  const auto piece = [&] {
    const Solid one =
        random() % 4 == 0 ? make_ellipsoid("e", 2, 3, 4, -3, 4) : random_primitive(random);
    return make_placed("p", one, random_frame(random));
  };
  Solid made = make_box("b", 4, 4, 4);
  for (int i = 1; i < solids; ++i) {
    const Solid next =
        random() % 3 == 0 && i + 1 < solids ? (++i, make_union("u", piece(), piece())) : piece();
    made = random() % 2 == 0 ? make_union("u", made, next) : make_subtraction("s", made, next);
  }
  return made;
}

TEST(CompiledSolids, OfManySolidsAnswerAsTheGenericNavigator) {
  std::mt19937_64 random(17);
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 90, 90, 20));
  for (int i = 0; i < 6; ++i) {
    const VolumeId leaf =
        tests::add_volume(world, "leaf" + std::to_string(i), random_boolean(random, 3 + 3 * i));
    tests::place(world, world.top, leaf, {-40.0 + 40 * (i % 3), -20.0 + 40 * (i / 3), 0});
  }
  finish(world);
  const auto shared = std::make_shared<const World>(std::move(world));
  Runtime bound(shared, solids_alone(JitMode::wait));
  std::vector<Ray> rays;
  for (int i = 0; i < 6000; ++i) {
    const Vec3 near{-40.0 + 40 * static_cast<double>(random() % 3) + uniform(random, -6, 6),
                    -20.0 + 40 * static_cast<double>(random() % 2) + uniform(random, -6, 6),
                    uniform(random, -6, 6)};
    rays.push_back({near, tests::random_direction(random)});
  }
  EXPECT_EQ(tests::traces_that_differ(bound, rays), 0U);
  EXPECT_GE(scenes_with_compiled_solids(bound.report()), 5U);
}

TEST(CompiledSolids, ComeWhileARunGoesOn) {
  const auto world = halls();
  RuntimeOptions options = solids_alone(JitMode::on);
  options.specialiser.safety = false;
  Runtime runtime(world, options);
  const std::vector<Ray> rays = tests::rays_through(*world, 5, 1000);
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (scenes_with_compiled_solids(runtime.report()) < 4 &&
         std::chrono::steady_clock::now() < give_up) {
    EXPECT_EQ(tests::traces_that_differ(runtime, rays), 0U);
  }
  const RuntimeReport report = runtime.report();
  EXPECT_EQ(scenes_with_compiled_solids(report), 4U);
  // A hall holds both beams, which are compiled together.
  for (const SceneReport& scene : report.scenes) {
    EXPECT_NE(scene.status, SceneStatus::compiling) << scene.volume;
  }
  EXPECT_EQ(tests::traces_that_differ(runtime, rays), 0U);
}

TEST(CompiledSolids, ComeFromTheCache) {
  const auto world = halls();
  const tests::TemporaryFolder folder;
  RuntimeOptions options = solids_alone(JitMode::wait);
  options.cache = Cache::in(folder.path());
  EXPECT_EQ(Runtime(world, options).report().cached_modules, 0U);
  Runtime again(world, options);
  EXPECT_GE(again.report().modules, 1U);
  EXPECT_EQ(again.report().cached_modules, again.report().modules);
  EXPECT_EQ(tests::traces_that_differ(again, tests::rays_through(*world, 6, 3000)), 0U);
  EXPECT_EQ(scenes_with_compiled_solids(again.report()), 4U);
}

/// Runs with these faults; returns how many scenes then have compiled solids. No answer may change.
std::size_t compiled_in_spite_of(std::shared_ptr<const Faults> faults, std::string& log) {
  const auto world = halls();
  FaultyOptions options{solids_alone(JitMode::wait)};
  options.faults = std::move(faults);
  options.log = [&](LogLevel, std::string_view line) { log += std::string(line) + "\n"; };
  FaultyRuntime runtime(world, options);
  EXPECT_EQ(tests::traces_that_differ(runtime, tests::rays_through(*world, 7, 300)), 0U);
  return scenes_with_compiled_solids(runtime.report());
}

TEST(CompiledSolids, WrongCodeIsFoundAndNotUsed) {
  std::string log;
  EXPECT_EQ(compiled_in_spite_of(tests::edited([](std::string& source) {
                                   const std::string call = "return distance_to_out(solid_";
                                   const std::size_t at = source.rfind(call);
                                   ASSERT_NE(at, std::string::npos);
                                   source.insert(at + 7, "(1 + 0x1p-52) * ");
                                 }),
                                 log),
            0U);
  EXPECT_NE(log.find("code for a solid is wrong and is not used: distance_to_out"),
            std::string::npos)
      << log;
}

TEST(CompiledSolids, AreLeftOutWhereTheyDoNotCompile) {
  std::string log;
  EXPECT_EQ(compiled_in_spite_of(
                tests::edited([](std::string& source) { source += "\nint broken = ;\n"; }), log),
            0U);
  EXPECT_NE(log.find("solids are not compiled: "), std::string::npos) << log;
}

/// The answers of a solid's kernels, and how often they were asked.
struct Counted {
  kernels::AnySolid<double> solid;
  double tolerance;
  mutable int asked = 0, asked_safety = 0;

  static const Counted& of(const void* data) { return *static_cast<const Counted*>(data); }
  kernels::SolidCode code() const {
    return {solid,
            [](const void* c, const Vec3& p, const Direction& v) {
              ++of(c).asked;
              return contains(of(c).solid, p, v, of(c).tolerance);
            },
            [](const void* c, const Vec3& p, const Direction& v) {
              ++of(c).asked;
              return distance_to_in(of(c).solid, p, v, of(c).tolerance);
            },
            [](const void* c, const Vec3& p, const Direction& v) {
              ++of(c).asked;
              return distance_to_out(of(c).solid, p, v, of(c).tolerance);
            },
            [](const void* c, const Vec3& p) {
              ++of(c).asked_safety;
              return safety_to_in(of(c).solid, p);
            },
            [](const void* c, const Vec3& p) {
              ++of(c).asked_safety;
              return safety_to_out(of(c).solid, p);
            },
            this};
  }
};

TEST(CompiledSolids, AreAskedByScenesBoundToData) {
  const auto world = halls();
  const Geometry geometry(world);
  const WorldFacts facts = analyse_world(geometry);
  const StateSampler sampler(geometry);
  std::vector<const kernels::DispatchEntry*> table(geometry.size(), &generic::dispatch_entry);
  const kernels::Context context{table.data(), &geometry, leave_at_once, return_at_once};
  for (VolumeId v = 0; v < geometry.size(); ++v) {
    const Scene& scene = geometry.scene(v);
    const auto solid = scene.daughters.empty() ? scene.solid : scene.daughters[1].solid;
    if (!codegen::gains_from_code(solid)) continue;
    const Counted counted{solid, geometry.tolerance()};
    const kernels::SolidCode code = counted.code();
    const codegen::CodeOfSolids codes{{solid.shape, &code}};
    codegen::Arena arena;
    const auto* bound =
        codegen::bind_to_data(geometry, plan_scene(geometry, facts, v), arena, &codes);
    EXPECT_EQ(verify(geometry, context, *bound, v, sampler.states(v, 400, 1)), "");
    EXPECT_GT(counted.asked, 100) << world->volumes[v].name;
    EXPECT_GT(counted.asked_safety, 100) << world->volumes[v].name;
  }
}

TEST(CompiledSolids, AreVerifiedFunctionByFunction) {
  const Solid solid = beam(10);
  const double tolerance = 1e-9;
  const Counted counted{solid.any(), tolerance};
  const auto problem = [&](const kernels::SolidCode& code) {
    return verify_solid(solid.any(), code, solid.extent, tolerance, 400, 1);
  };
  EXPECT_EQ(problem(counted.code()), "");
  kernels::SolidCode code = counted.code();
  code.safety_to_in = code.safety_to_out = nullptr;  // left to the kernels
  EXPECT_EQ(problem(code), "");
  code = counted.code();
  code.contains = [](const void*, const Vec3&, const Direction&) { return false; };
  EXPECT_NE(problem(code).find("contains is 0 instead of 1"), std::string::npos);
  code = counted.code();
  std::swap(code.distance_to_in, code.distance_to_out);
  EXPECT_NE(problem(code).find("distance_to_"), std::string::npos);
  code = counted.code();
  code.distance_to_out = [](const void* c, const Vec3& p, const Direction& v) {
    const double right = distance_to_out(Counted::of(c).solid, p, v, Counted::of(c).tolerance);
    return right > 3 ? right * (1 + 0x1p-52) : right;
  };
  EXPECT_NE(problem(code).find("distance_to_out is"), std::string::npos);
  code = counted.code();
  code.safety_to_in = code.safety_to_out;
  EXPECT_NE(problem(code).find("safety_to_in is"), std::string::npos);
}

}  // namespace
}  // namespace navjit
