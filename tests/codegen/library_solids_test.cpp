// The library's code for solids made of several, against the kernels of any solid, bit for bit.
#include "codegen/data/library_solids.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "analysis/plan.hpp"
#include "codegen/data/parts.hpp"
#include "codegen/shapes.hpp"
#include "runtime/verify_solid.hpp"
#include "tests/support/random_solids.hpp"
#include "tests/support/worlds.hpp"

namespace navjit::codegen {
namespace {

constexpr double tolerance = 1e-9;

constexpr double size_at_least = 0.5, size_at_most = 4;

Solid some_hull(std::mt19937_64& random) {
  const auto at = [&] { return uniform(random, size_at_least, size_at_most); };
  return make_tet("s", {-at(), -at(), -at()}, {at(), -at(), -at()}, {0, at(), -at()}, {0, 0, at()});
}

/// A prism over an L.
Solid some_prism(std::mt19937_64& random) {
  const double a = uniform(random, size_at_least, 1), b = uniform(random, 2, size_at_most);
  const PlanarPoint corners[] = {{-b, -b}, {b, -b}, {b, -a}, {-a, -a}, {-a, b}, {-b, b}};
  const ExtrudedSection sections[] = {{-a, 0, 0, 1}, {b, 0, 0, 1}};
  return make_extruded("s", corners, sections);
}

Solid some_trap(std::mt19937_64& random) {
  const auto size = [&] { return uniform(random, size_at_least, size_at_most); };
  const double x = size(), y = size(), wide = size(), far = uniform(random, 0.5, 2);
  return make_trap("s", size(), 0.1, 0.2, y, x, wide, 0.1, far * y, far * x, far * wide, 0.1);
}

/// Mostly boxes and tubes, of which real booleans mostly consist.
Solid some_operand(std::mt19937_64& random) {
  const auto size = [&] { return uniform(random, size_at_least, size_at_most); };
  switch (random() % 19) {
    case 0:
      return make_trd("s", size(), size(), size(), size(), size());
    case 1:
      return some_trap(random);
    case 2:
      return make_sphere("s", 0.2, 0.3 + size(), 0, 7, 0, 4);
    case 3: {
      const ZPlane planes[] = {{-size(), 0, size()}, {0, 0, size()}, {size(), 0, size()}};
      return make_polyhedra("s", planes, 6, 0, 7);
    }
    case 4: {
      const ZPlane planes[] = {{-size(), 0.1, size()}, {0, 0.2, size()}, {size(), 0, size()}};
      return make_polycone("s", planes, 0, 7);
    }
    case 5:
      return make_cone("s", 0, size(), 0.1, size(), size(), 0, 7);
    case 6:
      return some_hull(random);
    case 7:
      return some_prism(random);
    case 8:
      return make_ellipsoid("s", size(), size(), 4, -size(), size());
    case 9:
      return make_eltube("s", size(), size(), size());
    case 16:
    case 17:
    case 10:
    case 11:
      return make_tube("s", 0, size(), size(), 0, 7);
    default:
      return make_box("s", size(), size(), size());
  }
}

/// The solid as it is, or moved, or moved and turned.
Solid somewhere(std::mt19937_64& random, const Solid& solid) {
  return random() % 3 == 0 ? solid : make_placed("at", solid, random_frame(random));
}

Solid some_boolean(std::mt19937_64& random, const Solid& a, const Solid& b) {
  switch (random() % 4) {
    case 0:
      return make_union("s", a, b);
    case 1:
      return make_intersection("s", a, b);
    default:
      return make_subtraction("s", a, b);
  }
}

/// A wall with windows.
Solid some_wall(std::mt19937_64& random) {
  Solid wall = make_box("wall", 5, 5, 1);
  for (std::uint64_t windows = 1 + random() % 5; windows > 0; --windows) {
    const Solid window = make_box("w", uniform(random, 0.3, 1), uniform(random, 0.3, 1), 2);
    wall = make_subtraction("s", wall, somewhere(random, window));
  }
  return wall;
}

/// Three solids in a row, as in a coil or a frame.
Solid some_row(std::mt19937_64& random) {
  const auto part = [&] {
    const auto size = [&] { return uniform(random, size_at_least, size_at_most); };
    switch (random() % 5) {
      case 0:
        return make_box("s", size(), size(), size());
      case 1:
        return some_trap(random);
      case 2:
        return some_hull(random);
      case 3:
        return some_prism(random);
      default:
        return make_tube("s", 0, size(), size(), 0, 7);
    }
  };
  Solid row = part();
  for (int i = 0; i < 2; ++i) row = make_union("s", row, somewhere(random, part()));
  return row;
}

/// A boolean of two or three solids, a row, a hull less two solids, or a wall; nothing if nothing
/// is left of it.
std::optional<Solid> some_solid(std::mt19937_64& random) {
  try {
    if (random() % 8 == 0) return some_wall(random);
    if (random() % 8 == 0) return somewhere(random, some_row(random));
    if (random() % 64 == 0) {
      return make_subtraction("s", some_hull(random),
                              make_union("s", some_hull(random), some_hull(random)));
    }
    const Solid two =
        some_boolean(random, some_operand(random), somewhere(random, some_operand(random)));
    switch (random() % 3) {
      case 0:
        return somewhere(random, two);
      case 1:
        return some_boolean(random, two, somewhere(random, some_operand(random)));
      default:
        return some_boolean(random, some_operand(random), somewhere(random, two));
    }
  } catch (const GeometryError&) {
    return std::nullopt;
  }
}

TEST(LibrarySolids, HaveTheBitsOfAnySolidsKernels) {
  const std::vector<std::string> structures = library_structures();
  std::map<std::string, int> met;
  std::mt19937_64 random(1);
  Arena arena;
  int with = 0, without = 0;
  for (int n = 0; n < 400000; ++n) {
    const std::optional<Solid> solid = some_solid(random);
    if (!solid) continue;
    const std::string type = Shapes(true).type(solid->any());
    const bool listed = std::find(structures.begin(), structures.end(), type) != structures.end();
    ASSERT_EQ(is_in_library(solid->any()), listed) << type;
    (listed ? with : without) += 1;
    if (!listed || met[type]++ >= 20) continue;
    const kernels::SolidCode* code = library_code(solid->any(), tolerance, arena);
    ASSERT_NE(code, nullptr) << type;
    EXPECT_EQ(code->solid.shape, solid->shape.get());
    ASSERT_NE(code->safety_to_in, nullptr);
    ASSERT_EQ(verify_solid(solid->any(), *code, solid->extent, tolerance, 200, n + 1), "") << type;
  }
  for (const std::string& type : structures) EXPECT_GT(met[type], 0) << type << " was not tried";
  EXPECT_GT(with, 0);
  EXPECT_GT(without, 0);
}

TEST(LibrarySolids, AreDifferentStructures) {
  const std::vector<std::string> structures = library_structures();
  EXPECT_EQ(std::set(structures.begin(), structures.end()).size(), structures.size());
}

TEST(LibrarySolids, ArePlainOnesToo) {
  std::mt19937_64 random(2);
  Arena arena;
  std::set<SolidKind> with, without;
  for (int n = 0; n < 2000; ++n) {
    const Solid solid = n % 50 == 0   ? make_orb("s", 2)
                        : n % 50 == 1 ? make_torus("s", 0, 1, 3, 0, 7)
                                      : some_operand(random);
    EXPECT_EQ(library_code(solid.any(), tolerance, arena), nullptr) << "made of several";
    const kernels::SolidCode* code = plain_code(solid.any(), tolerance, arena);
    (code != nullptr ? with : without).insert(solid.kind);
    if (code == nullptr) continue;
    ASSERT_EQ(verify_solid(solid.any(), *code, solid.extent, tolerance, 100, n + 1), "");
    // Its numbers lie beside its code.
    EXPECT_EQ(code->solid.kind, solid.kind);
    const auto *numbers = static_cast<const char*>(code->solid.shape),
               *start = static_cast<const char*>(code->data);
    EXPECT_TRUE(numbers > start && numbers < start + 256);
  }
  EXPECT_EQ(with.size(), 13U);
  EXPECT_EQ(without, std::set{SolidKind::box});
}

TEST(LibrarySolids, AreNoOthers) {
  Arena arena;
  const Solid box = make_box("box", 1, 2, 3);
  for (const Solid& solid :
       {box, make_placed("moved", box, {}), make_twistedbox("t", 0.5, 1, 2, 3)}) {
    EXPECT_EQ(library_code(solid.any(), tolerance, arena), nullptr);
    EXPECT_EQ(plain_code(solid.any(), tolerance, arena), nullptr);
  }
}

/// Of mothers and of daughters.
TEST(LibrarySolids, AreWhatScenesThatAreBoundToDataAsk) {
  const Solid frame = make_subtraction("frame", make_box("b", 2, 2, 2), make_box("h", 1, 1, 3));
  World world;
  world.top = tests::add_volume(
      world, "world", make_subtraction("w", make_box("b", 90, 90, 90), make_box("h", 9, 9, 99)));
  const VolumeId volume = tests::add_volume(world, "frame", frame);
  tests::place(world, world.top, volume, {40, 0, 0});
  tests::place(world, world.top, volume, {-40, 0, 0}, {0, 0, 0.5});
  finish(world);
  const Geometry geometry(std::make_shared<const World>(std::move(world)));
  const VolumeId top = geometry.world().top;
  const ScenePlan plan = plan_scene(geometry, analyse_world(geometry), top);
  Arena arena;
  const Source source{geometry, plan, geometry.scene(top), arena};
  AnyDaughters daughters;
  make(source, daughters);
  kernels::QuickSolid mother;
  make(source, mother);
  EXPECT_TRUE(mother.has_code);
  ASSERT_EQ(daughters.count, 2U);
  EXPECT_TRUE(daughters.at[0].solid.has_code);
  EXPECT_EQ(daughters.at[0].solid.shape, daughters.at[1].solid.shape) << "one solid has one code";
}

}  // namespace
}  // namespace navjit::codegen
