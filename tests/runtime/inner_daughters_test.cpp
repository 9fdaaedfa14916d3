// Whether a daughter has daughters of its own where it is entered: in doubt it has.
#include "codegen/data/inner.hpp"

#include <gtest/gtest.h>

#include "tests/support/traces.hpp"

namespace navjit {
namespace {

using kernels::InnerDaughters;

struct Case {
  const char* name;
  Solid outer, inner;
  Vec3 at{0, 0, 0}, angles{0, 0, 0};
  InnerDaughters expected;
};

Solid box(double half) { return make_box("b", half, half, half); }

const double none = 7;  // an angle above a full turn
const Case cases[] = {
    {"a box deep in one", box(10), box(9), {}, {}, kernels::deep_daughters},
    {"a box at a face", box(10), box(9), {1, 0, 0}, {}, kernels::has_surface_daughters},
    {"a box nearly at a face",
     box(10),
     box(9),
     {0, 0.99999, 0},
     {},
     kernels::has_surface_daughters},
    {"a box that sticks out", box(10), box(9), {0, 0, -2}, {}, kernels::has_surface_daughters},
    {"a turned box deep in one", box(10), box(5), {}, {0.3, 0.2, 0.7}, kernels::deep_daughters},
    {"a turned box at an edge", box(10), box(8), {}, {0, 0, 0.7}, kernels::has_surface_daughters},
    {"a tube within a tube",
     make_tube("t", 2, 10, 5, 0, none),
     make_tube("i", 3, 9, 4, 0, none),
     {},
     {},
     kernels::deep_daughters},
    {"a tube at the inner wall",
     make_tube("t", 2, 10, 5, 0, none),
     make_tube("i", 2, 9, 4, 0, none),
     {},
     {},
     kernels::has_surface_daughters},
    {"a tube at the outer wall",
     make_tube("t", 2, 10, 5, 0, none),
     make_tube("i", 3, 9, 4, 0, none),
     {0.6, 0.8, 0},
     {},
     kernels::has_surface_daughters},
    {"a tube at an end",
     make_tube("t", 2, 10, 5, 0, none),
     make_tube("i", 3, 9, 4, 0, none),
     {0, 0, 1},
     {},
     kernels::has_surface_daughters},
    {"a box across the hole",
     make_tube("t", 2, 10, 5, 0, none),
     box(1),
     {1, 0, 0},
     {},
     kernels::has_surface_daughters},
    {"a box beside the hole",
     make_tube("t", 2, 10, 5, 0, none),
     box(1),
     {5, 0, 0},
     {},
     kernels::deep_daughters},
    {"a box in a half tube",
     make_tube("t", 0, 10, 5, 0, 3.14159),
     box(1),
     {5, 0.5, 0},
     {},
     kernels::has_surface_daughters},
    {"an orb within an orb", make_orb("o", 10), make_orb("i", 5), {}, {}, kernels::deep_daughters},
    {"an orb at an orb",
     make_orb("o", 10),
     make_orb("i", 5),
     {5, 0, 0},
     {},
     kernels::has_surface_daughters},
};

struct Made {
  std::shared_ptr<World> world = std::make_shared<World>();
  VolumeId outer;

  explicit Made(const Case& c) {
    world->top = tests::add_volume(*world, "world", box(100));
    outer = tests::add_volume(*world, "outer", c.outer);
    const VolumeId inner = tests::add_volume(*world, "inner", c.inner);
    tests::place(*world, outer, inner, c.at, c.angles);
    // Beside something else, in many places, so that the scene is more than one daughter.
    for (int i = 0; i < 5; ++i) tests::place(*world, world->top, outer, {-60.0 + 30 * i, 0, 0});
    finish(*world);
  }
};

TEST(InnerDaughters, AreDeepWhereNoneCanBeMetOnEntering) {
  for (const Case& c : cases) {
    const Made made(c);
    const Geometry geometry(made.world);
    EXPECT_EQ(codegen::inner_of(geometry, made.outer), c.expected) << c.name;
    EXPECT_EQ(codegen::inner_of(geometry, made.outer + 1), kernels::no_daughters);
  }
}

TEST(InnerDaughters, ChangeNoTrace) {
  for (const Case& c : cases) {
    const Made made(c);
    RuntimeOptions options = tests::eager_options(JitMode::wait);
    options.specialiser.constants = options.specialiser.structures = false;
    options.specialiser.solids = false;
    Runtime runtime(std::shared_ptr<const World>(made.world), options);
    const std::vector<Ray> rays = tests::rays_through(*made.world, 5, 400);
    EXPECT_EQ(tests::traces_that_differ(runtime, rays), 0U) << c.name;
    runtime.wait_until_idle();
    EXPECT_EQ(tests::traces_that_differ(runtime, rays), 0U) << c.name;
    bool bound = false;
    for (const SceneReport& scene : runtime.report().scenes) {
      bound |= scene.volume == "world" && scene.binding == Binding::data;
    }
    EXPECT_TRUE(bound) << c.name;
  }
}

}  // namespace
}  // namespace navjit
