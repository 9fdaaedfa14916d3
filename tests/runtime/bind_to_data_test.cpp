// Scenes bound to data, compared with the generic navigator bit for bit, without any compiler.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <set>
#include <string>

#include "analysis/plan.hpp"
#include "codegen/data/bind.hpp"
#include "geometry/gdml/read_world.hpp"
#include "geometry/navigation/generic.hpp"
#include "geometry/navigation/steps_of_no_length.hpp"
#include "navjit/runtime.hpp"
#include "runtime/overrides.hpp"
#include "runtime/states.hpp"
#include "runtime/verify.hpp"
#include "tests/support/traces.hpp"
#include "tests/support/wires.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

using tests::rays_through;
using tests::same_bits;
using tests::trace;

RuntimeOptions data_alone(JitMode jit) {
  RuntimeOptions options = tests::eager_options(jit);
  options.specialiser.constants = false;
  options.specialiser.structures = false;
  options.specialiser.solids = false;
  options.specialiser.keep_only_faster = false;
  return options;
}

/// Expects the same traces and safeties; data-bound navigators must have made nearly all steps.
void expect_same_answers(const std::shared_ptr<const World>& world, std::uint64_t seed,
                         const std::vector<Ray>& rays) {
  Runtime generic(world, data_alone(JitMode::off)), bound(world, data_alone(JitMode::wait));
  Navigator a = generic.navigator(), b = bound.navigator();
  std::mt19937_64 random(seed);
  std::uint64_t of_length_zero = 0;
  for (const Ray& ray : rays) {
    const auto right = trace(a, ray, world->tolerance), got = trace(b, ray, world->tolerance);
    for (const tests::Row& row : got) of_length_zero += row.length == 0 ? 1 : 0;
    ASSERT_TRUE(same_bits(right, got))
        << "ray from " << ray.position.x << ' ' << ray.position.y << ' ' << ray.position.z;
    // Limited steps, and a direction that changes on the way, as particles that scatter have it.
    Vec3 p = ray.position;
    State s = a.locate(p, ray.direction);
    for (int i = 0; i < 6 && s.inside(); ++i) {
      const Vec3 v = tests::random_direction(random);
      const double limit = tests::uniform(random, 0, 30);
      const double safety = a.safety(s, p), bound_safety = b.safety(s, p);
      ASSERT_TRUE(kernels::same_bits(safety, bound_safety)) << safety;
      const Step one = a.step(s, p, v, limit), other = b.step(s, p, v, limit);
      ASSERT_TRUE(kernels::same_bits(one.length, other.length));
      ASSERT_EQ(one.boundary, other.boundary);
      ASSERT_EQ(one.next, other.next);
      of_length_zero += other.length == 0 ? 1 : 0;
      p = p + one.length * v;
      s = one.next;
    }
  }
  std::uint64_t steps = 0, by_data = 0;
  for (const SceneReport& scene : bound.report().scenes) {
    EXPECT_NE(scene.status, SceneStatus::failed) << scene.volume << ": " << scene.note;
    steps += scene.steps;
    by_data += scene.binding == Binding::data ? scene.steps : 0;
  }
  EXPECT_EQ(by_data, steps) << "every scene of every detector has an instance";
  EXPECT_LE(b.counts().bail_outs, of_length_zero) << "these alone are left to the generic one";
  EXPECT_EQ(bound.report().modules, 0U);
}

void expect_same_answers(const std::shared_ptr<const World>& world, std::uint64_t seed, int rays) {
  expect_same_answers(world, seed, rays_through(*world, seed, rays));
}

/// Forces a search for all scenes as long as this object lives.
struct Forced {
  explicit Forced(const char* variant) { setenv(overrides_variable, variant, 1); }
  ~Forced() { unsetenv(overrides_variable); }
};

const char* const searches[] = {"",       "*=all",   "*=lanes", "*=nest",   "*=rings", "*=wires",
                                "*=grid", "*=boxes", "*=scan",  "*=groups", "*=tree",  "*=layers"};

TEST(BoundToData, MixedWorldAlikeWithEachSearch) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  for (const char* search : searches) {
    SCOPED_TRACE(search);
    const Forced forced(search);
    expect_same_answers(world, 1, 600);
  }
}

TEST(BoundToData, RandomWorldsAlikeWithEachSearch) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const auto world = std::make_shared<const World>(tests::random_world(seed, 3));
    for (const char* search : searches) {
      SCOPED_TRACE(std::to_string(seed) + search);
      const Forced forced(search);
      expect_same_answers(world, seed, 200);
    }
  }
}

TEST(BoundToData, OverlapsAlike) {
  std::mt19937_64 random(5);
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 20, 20, 20));
  for (int i = 0; i < 12; ++i) {
    const std::string name = "v" + std::to_string(i);
    const VolumeId v = tests::add_volume(
        world, name, make_box(name, tests::uniform(random, 2, 8), tests::uniform(random, 2, 8), 5));
    // Overlapping each other and sticking out of the world.
    tests::place(world, world.top, v,
                 {tests::uniform(random, -18, 18), tests::uniform(random, -18, 18),
                  tests::uniform(random, -18, 18)},
                 {0, 0, i % 3 == 0 ? 0.0 : tests::uniform(random, 0, 3)});
  }
  finish(world);
  const auto shared = std::make_shared<const World>(std::move(world));
  for (const char* search : searches) {
    SCOPED_TRACE(search);
    const Forced forced(search);
    expect_same_answers(shared, 6, 400);
  }
}

/// Layers of tiles and plates, as they come from a file that places all of them in the world.
TEST(BoundToData, FlatCalorimeterAlikeByLayers) {
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 70, 70, 120));
  const VolumeId tile = tests::add_volume(world, "tile", make_box("tile", 6, 6, 1.5));
  const VolumeId plate = tests::add_volume(world, "plate", make_box("plate", 50, 50, 3));
  for (int layer = 0; layer < 12; ++layer) {
    const double z = -100 + 16.0 * layer;
    for (int i = 0; i < 8; ++i) {
      for (int j = 0; j < 8; ++j) {
        tests::place(world, world.top, tile, {-42 + 12.0 * i, -42 + 12.0 * j, z},
                     {0, 0, layer % 3 == 0 ? 0.05 : 0.0});
      }
    }
    tests::place(world, world.top, plate, {0, 0, z + (layer % 2 == 0 ? 4.5 : 4.3)});
  }
  finish(world);
  const auto shared = std::make_shared<const World>(std::move(world));
  const Geometry geometry(shared);
  ScenePlan plan = plan_scene(geometry, analyse_world(geometry), 0);
  ASSERT_TRUE(plan.layers.found());
  // There are too many daughters to look at all for the safety, but layers tell it.
  EXPECT_EQ(plan.safety, SafetyFrom::generic);
  codegen::Arena arena;
  plan.candidates = Candidates::layers;
  EXPECT_NE(codegen::bind_to_data(geometry, plan, arena)->safety, generic::dispatch_entry.safety);
  plan.candidates = Candidates::tree;
  EXPECT_EQ(codegen::bind_to_data(geometry, plan, arena)->safety, generic::dispatch_entry.safety);
  expect_same_answers(shared, 22, 600);
  const Forced forced("*=layers");
  expect_same_answers(shared, 23, 600);
}

/// Voxels of two kinds that fill a box; one in so many is missing.
World phantom(int voxels, unsigned one_missing_in, double shift, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const double half = 2.0 * voxels;
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", half + 30, half + 20, half + 10));
  const VolumeId voxel[] = {tests::add_volume(world, "tissue", make_box("tissue", 2, 2, 2)),
                            tests::add_volume(world, "bone", make_box("bone", 2, 2, 2))};
  for (int i = 0; i < voxels; ++i) {
    for (int j = 0; j < voxels; ++j) {
      for (int k = 0; k < voxels; ++k) {
        if (one_missing_in > 0 && random() % one_missing_in == 0) continue;
        tests::place(world, world.top, voxel[random() % 5 == 0 ? 1 : 0],
                     {4 * (i + 0.5) - half + tests::uniform(random, 0, shift),
                      4 * (j + 0.5) - half + tests::uniform(random, 0, shift),
                      4 * (k + 0.5) - half + tests::uniform(random, 0, shift)});
      }
    }
  }
  finish(world);
  return world;
}

/// What the log said when the world was bound to data.
std::string words_of_binding(const std::shared_ptr<const World>& world) {
  RuntimeOptions options = data_alone(JitMode::wait);
  std::mutex mutex;
  std::string lines;
  options.log = [&](LogLevel, std::string_view line) {
    const std::lock_guard lock(mutex);
    lines += std::string(line) + '\n';
  };
  { const Runtime runtime(world, options); }
  const std::size_t bound = lines.find("event=bound");
  return bound == std::string::npos ? "" : lines.substr(bound, lines.find('\n', bound) - bound);
}

/// Strips side by side in a sensor: slabs, or where beads are among them wires, find what a ray
/// meets, and layers what is near.
TEST(BoundToData, SafetiesAmongManySlabsAreToldByLayers) {
  for (const bool beads : {false, true}) {
    SCOPED_TRACE(beads);
    World world;
    world.top = tests::add_volume(world, "world", make_box("world", 60, 20, 10));
    const VolumeId strip = tests::add_volume(world, "strip", make_box("strip", 0.08, 15, 0.2));
    const VolumeId bead = tests::add_volume(world, "bead", make_orb("bead", 0.06));
    for (int i = 0; i < 400; ++i) {
      tests::place(world, world.top, beads && i % 9 == 0 ? bead : strip,
                   {-50 + 0.25 * i, 0, beads ? 0.01 * (i % 5) : 0});
    }
    finish(world);
    const auto shared = std::make_shared<const World>(std::move(world));
    const Geometry geometry(shared);
    const ScenePlan plan = plan_scene(geometry, analyse_world(geometry), 0);
    EXPECT_EQ(plan.candidates, beads ? Candidates::wires : Candidates::slabs);
    EXPECT_TRUE(plan.layers.found());
    expect_same_answers(shared, 25, 600);
    // Whichever way of finding daughters was the fastest.
    const std::string line = words_of_binding(shared);
    EXPECT_NE(line.find("scene=\"world\""), std::string::npos) << line;
    EXPECT_NE(line.find(" safety=layers "), std::string::npos) << line;
  }
}

/// More voxels than boxes are made for.
TEST(BoundToData, PhantomsOfManyVoxelsAlikeByLayers) {
  for (const unsigned one_missing_in : {0U, 7U}) {
    SCOPED_TRACE(one_missing_in);
    const auto world = std::make_shared<const World>(phantom(35, one_missing_in, 0, 31));
    const Geometry geometry(world);
    const ScenePlan plan = plan_scene(geometry, analyse_world(geometry), 0);
    EXPECT_EQ(codegen::structure_of(geometry, plan), "unrotated box, layers of boxes");
    EXPECT_TRUE(geometry.scene(0).neighbour_lists.of.empty()) << "what they hold is in no cache";
    expect_same_answers(world, 32, 60);
  }
}

TEST(BoundToData, WhatIsNotInLayersIsFoundByTheTree) {
  const auto world = std::make_shared<const World>(phantom(35, 7, 1.9, 33));
  const Geometry geometry(world);
  const ScenePlan plan = plan_scene(geometry, analyse_world(geometry), 0);
  EXPECT_FALSE(plan.layers.found());
  EXPECT_EQ(codegen::structure_of(geometry, plan), "unrotated box, tree of boxes");
  expect_same_answers(world, 34, 60);
}

/// A chamber of wires, placed twice, once turned, and another chamber with the same wires.
World chambers(const tests::Stringing& s, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 700, 200, 200));
  const VolumeId chamber = tests::add_volume(world, "chamber", make_box("chamber", 90, 90, 90));
  const VolumeId other = tests::add_volume(world, "other", make_box("other", 90, 90, 90));
  tests::string_wires(world, chamber, s, random);
  world.volumes[other].daughters = world.volumes[chamber].daughters;
  tests::place(world, world.top, chamber, {-180, 0, 0});
  tests::place(world, world.top, chamber, {180, 0, 0}, {0.4, -0.9, 0.3});
  tests::place(world, world.top, other, {520, 0, 0}, {1.4, -0.9, 0.3});
  finish(world);
  return world;
}

TEST(BoundToData, ChambersOfWiresAlike) {
  std::size_t safeties = 0;
  for (const auto& [name, s] : tests::stringings()) {
    SCOPED_TRACE(name);
    const auto world = std::make_shared<const World>(chambers(s, 9));
    std::mt19937_64 random(10);
    std::vector<Ray> rays = rays_through(*world, 11, 200);
    for (int i = 0; i < 400; ++i) {
      const auto [p, d] = tests::ray_among_wires(random, s, i);
      rays.push_back({p + Vec3{-180, 0, 0}, d});
    }
    const Forced forced("chamber=wires,other=wires");
    expect_same_answers(world, 12, rays);
    const Geometry geometry(world);
    WorldFacts facts = analyse_world(geometry);
    facts.forced_candidates[1] = Candidates::wires;
    const ScenePlan plan = plan_scene(geometry, facts, 1);
    ASSERT_EQ(plan.candidates, Candidates::wires);
    EXPECT_EQ(codegen::structure_of(geometry, plan),
              s.bars ? "box, wires of solids" : "box, wires of tubes");
    EXPECT_FALSE(worth_compiling(geometry, plan));
    safeties += plan.safety == SafetyFrom::wires ? 1 : 0;
  }
  EXPECT_GE(safeties, 12U);
}

/// Each wire is rare, and all of them together are hot.
TEST(BoundToData, WiresOfManyLengthsAreBoundTogether) {
  tests::Stringing s;
  s.wires = 1200;
  s.pitch = 0.1;
  s.radius = 0.04;
  const auto world = std::make_shared<const World>(chambers(s, 13));
  RuntimeOptions options = data_alone(JitMode::on);
  Runtime runtime(world, options);
  Navigator navigator = runtime.navigator();
  std::mt19937_64 random(14);
  for (int i = 0; i < 8000; ++i) {
    const auto [p, d] = tests::ray_among_wires(random, s, 0);
    trace(navigator, {p + Vec3{-180, 0, 0}, d}, world->tolerance);
  }
  runtime.wait_until_idle();
  std::size_t bound = 0, seen = 0;
  std::uint64_t most = 0;
  for (const SceneReport& scene : runtime.report().scenes) {
    if (!scene.volume.starts_with("wire")) continue;
    ++seen;
    most = std::max(most, scene.steps);
    bound += scene.binding == Binding::data ? 1 : 0;
  }
  EXPECT_EQ(bound, seen);
  EXPECT_GT(seen, 500U);
  EXPECT_LT(most, 500U) << "none is hot by itself";
}

/// Plates with gaps; each layer has two plates of its own.
World layers_of_their_own(int layers) {
  World world;
  const double pitch = 2.2, half = pitch * layers / 2;
  world.top = tests::add_volume(world, "world", make_box("world", 60, 60, half));
  for (int i = 0; i < layers; ++i) {
    const std::string number = std::to_string(i);
    const double wide = 50 - 0.01 * i;
    const VolumeId layer =
        tests::add_volume(world, "layer" + number, make_box("layer", wide, wide, 1));
    for (const double z : {-0.45, 0.45}) {
      const VolumeId plate = tests::add_volume(world, "plate" + number + (z < 0 ? "a" : "b"),
                                               make_box("plate", wide - 5 + z, wide - 5, 0.2));
      tests::place(world, layer, plate, {0, 0, z});
    }
    tests::place(world, world.top, layer, {0, 0, pitch * (i + 0.5) - half});
  }
  finish(world);
  return world;
}

/// Each plate is rare, and so are the two of a layer, and the layer itself; all together have most
/// of the steps.
TEST(BoundToData, ScenesThatAreRareAreBoundTogether) {
  constexpr int layers = 300, rays = 60;
  const auto world = std::make_shared<const World>(layers_of_their_own(layers));
  Runtime runtime(world, data_alone(JitMode::on));
  Navigator navigator = runtime.navigator();
  std::mt19937_64 random(15);
  for (int i = 0; i < rays; ++i) {
    const Vec3 along{tests::uniform(random, -0.01, 0.01), tests::uniform(random, -0.01, 0.01), 1};
    const Vec3 start{tests::uniform(random, -20, 20), tests::uniform(random, -20, 20), -329.95};
    trace(navigator, {start, (1 / norm(along)) * along}, world->tolerance);
  }
  runtime.wait_until_idle();
  std::map<std::string, std::size_t> bound, seen;
  for (const SceneReport& scene : runtime.report().scenes) {
    const std::string kind = scene.volume.substr(0, 5);
    ++seen[kind];
    if (kind == "plate") {
      EXPECT_LT(2 * scene.steps, 500U) << "none is hot, nor are both of a layer";
    } else if (kind == "layer") {
      EXPECT_LT(scene.steps, 500U) << "nor is that";
    }
    bound[kind] += scene.binding == Binding::data ? 1 : 0;
  }
  EXPECT_EQ(seen["plate"], 2U * layers);
  EXPECT_EQ(seen["layer"], layers);
  EXPECT_EQ(bound, seen);
}

TEST(BoundToData, ShippedDetectorsAlike) {
  for (const auto& entry : std::filesystem::directory_iterator(NAVJIT_DETECTORS_DIR)) {
    if (entry.path().extension() != ".gdml") continue;
    SCOPED_TRACE(entry.path().filename().string());
    expect_same_answers(std::make_shared<const World>(read_world(entry.path().string())), 3, 300);
  }
}

TEST(BoundToData, ScenesOfOneStructureShareTheirCode) {
  const auto world = std::make_shared<const World>(
      read_world(std::string(NAVJIT_DETECTORS_DIR) + "/shashlik.gdml"));
  const Geometry geometry(world);
  const WorldFacts facts = analyse_world(geometry);
  codegen::Arena arena;
  std::map<std::string, std::set<kernels::StepFunction>> code;
  std::size_t scenes = 0;
  for (VolumeId v = 0; v < geometry.size(); ++v) {
    if (!facts.reachable[v]) continue;
    const ScenePlan plan = plan_scene(geometry, facts, v);
    const kernels::DispatchEntry* bound = codegen::bind_to_data(geometry, plan, arena);
    ASSERT_NE(bound->data, nullptr);
    code[codegen::structure_of(geometry, plan)].insert(bound->step);
    ++scenes;
  }
  EXPECT_LT(code.size(), scenes);
  for (const auto& [structure, functions] : code) EXPECT_EQ(functions.size(), 1U) << structure;
}

/// Wrong numbers are found out before they are installed.
TEST(BoundToData, WrongDataDoesNotVerify) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  const Geometry geometry(world);
  const WorldFacts facts = analyse_world(geometry);
  const StateSampler sampler(geometry);
  std::vector<const kernels::DispatchEntry*> table(geometry.size(), &generic::dispatch_entry);
  const kernels::Context context{table.data(), &geometry, leave_at_once, return_at_once};
  codegen::Arena arena;
  for (VolumeId v = 0; v < geometry.size(); ++v) {
    const std::vector<Sample> states = sampler.states(v, 64, 1);
    const auto* bound = codegen::bind_to_data(geometry, plan_scene(geometry, facts, v), arena);
    EXPECT_EQ(verify(geometry, context, *bound, v, states), "");
    const VolumeId other = (v + 1) % static_cast<VolumeId>(geometry.size());
    const auto* wrong = codegen::bind_to_data(geometry, plan_scene(geometry, facts, other), arena);
    EXPECT_NE(verify(geometry, context, *wrong, v, states), "") << world->volumes[v].name;
  }
}

TEST(BoundToData, HotScenesAreBoundWhileARunGoesOn) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  Runtime runtime(world, data_alone(JitMode::on));
  Navigator navigator = runtime.navigator();
  for (const Ray& ray : rays_through(*world, 7, 4000)) trace(navigator, ray, world->tolerance);
  runtime.wait_until_idle();
  std::size_t bound = 0;
  for (const SceneReport& scene : runtime.report().scenes) {
    if (scene.binding != Binding::data) continue;
    ++bound;
    EXPECT_GT(scene.swapped_at_s, 0);
    EXPECT_GT(scene.specialised_at_s, 0);
    EXPECT_GT(scene.specialised_ns_per_step, 0);
  }
  EXPECT_GT(bound, 2U);
  EXPECT_GE(runtime.specialised(), bound);
}

TEST(BoundToData, ASceneThatIsForcedOffStaysGeneric) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  const Forced forced("plate=off");
  Runtime runtime(world, data_alone(JitMode::wait));
  Navigator navigator = runtime.navigator();
  for (const Ray& ray : rays_through(*world, 8, 400)) trace(navigator, ray, world->tolerance);
  bool seen = false;
  for (const SceneReport& scene : runtime.report().scenes) {
    EXPECT_EQ(scene.binding, scene.volume == "plate" ? Binding::generic : Binding::data)
        << scene.volume;
    seen |= scene.volume == "plate";
  }
  EXPECT_TRUE(seen);
}

}  // namespace
}  // namespace navjit
