#include "codegen/module.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "codegen/kernel_names.hpp"
#include "codegen/kernel_texts.hpp"
#include "geometry/navigation/scene.hpp"
#include "geometry/solids/kinds.hpp"
#include "tests/support/worlds.hpp"

namespace navjit::codegen {
namespace {

TEST(Module, HoldsTheKernelsItNeedsAndNoOthers) {
  const Geometry geometry(std::make_shared<const World>(tests::mixed_world()));
  const WorldFacts facts = analyse_world(geometry);
  for (VolumeId v = 0; v < geometry.size(); ++v) {
    const Module module = generate(geometry, facts, std::array{v});
    ASSERT_EQ(module.entries.size(), 1U);
    EXPECT_EQ(module.source.find("#include"), std::string::npos);
    EXPECT_NE(module.source.find("double " + module.entries[0].step + "("), std::string::npos);
    EXPECT_EQ(module.source.find("struct Polycone"), std::string::npos);
    if (geometry.world().volumes[v].name == "tile") {
      // A box in a stack of boxes: no boolean anywhere near.
      EXPECT_EQ(module.source.find("struct Subtraction"), std::string::npos);
    }
  }
}

/// The part of a scene's text that is its own, without the kernels.
std::string own_text(const Module& module) {
  return module.source.substr(module.source.find("using Tolerance = "));
}

TEST(Module, ScenesAreTypesAndNumbers) {
  const Geometry geometry(std::make_shared<const World>(tests::mixed_world()));
  const WorldFacts facts = analyse_world(geometry);
  std::vector<VolumeId> all(geometry.size());
  std::iota(all.begin(), all.end(), VolumeId{0});
  const Module module = generate(geometry, facts, all);
  const std::string text = own_text(module);
  for (const char* logic : {"if (", "for (", "while (", "? ", "operator"}) {
    EXPECT_EQ(text.find(logic), std::string::npos) << logic;
  }
  for (const char* type :
       {"ConstantFrame<", "ConstantSolid<", "ListedDaughters<", "ClassedDaughters<",
        "ConstantSearch<", "LeaveToScene<", "LeaveWorld", "EnterScenes<", "EnterLeaves"}) {
    EXPECT_NE(text.find(type), std::string::npos) << type;
  }
  EXPECT_NE(module.data, nullptr);
  EXPECT_NE(module.owner, nullptr);
}

TEST(Module, LargeTablesAreNoText) {
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 5000, 10, 10));
  const VolumeId slab = tests::add_volume(world, "slab", make_box("slab", 0.4, 5, 5));
  const VolumeId core = tests::add_volume(world, "core", make_box("core", 0.2, 1, 1));
  tests::place(world, slab, core, {0, 0, 0});
  for (int i = 0; i < 4000; ++i) tests::place(world, world.top, slab, {i - 2000.0, 0, 0});
  finish(world);
  const Geometry geometry(std::make_shared<const World>(std::move(world)));
  const Module module =
      generate(geometry, analyse_world(geometry), std::array<VolumeId, 1>{geometry.world().top});
  EXPECT_LT(own_text(module).size(), 10000U);
}

/// The code for a box in a hall, with so many boxes with a hole, each of another size.
Module leaf_in_a_hall(int cut) {
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 1000, 1000, 1000));
  const VolumeId hall = tests::add_volume(world, "hall", make_box("hall", 900, 900, 900));
  tests::place(world, world.top, hall, {0, 0, 0});
  const VolumeId leaf = tests::add_volume(world, "leaf", make_box("leaf", 5, 5, 5));
  tests::place(world, hall, leaf, {0, 0, 0});
  for (int i = 0; i < cut; ++i) {
    Solid solid = make_box("whole", 5 + i, 5, 5);
    solid = make_subtraction("cut", solid, make_tube("hole", 0, 1, 6, 0, 7));
    const VolumeId volume = tests::add_volume(world, "cut", solid);
    tests::place(world, hall, volume, {0, 40.0 * (i + 1), 0});
  }
  finish(world);
  const Geometry geometry(std::make_shared<const World>(std::move(world)));
  return generate(geometry, analyse_world(geometry), std::array{leaf});
}

TEST(Module, RelocationInDearMothersIsLeftToTheTable) {
  const std::string cheap = own_text(leaf_in_a_hall(2)), dear = own_text(leaf_in_a_hall(12));
  EXPECT_NE(cheap.find("LeaveToScene<"), std::string::npos);
  EXPECT_NE(cheap.find("Subtraction"), std::string::npos);
  EXPECT_EQ(dear.find("LeaveToScene<"), std::string::npos);
  EXPECT_NE(dear.find("LeaveToVolume<"), std::string::npos);
  EXPECT_EQ(dear.find("Subtraction"), std::string::npos);
}

/// Plates of three thicknesses and one rod in a hall, and the code for the named ones.
Module plates_in_a_hall(const std::vector<std::string>& hot, Leaves leaves_share) {
  World world;
  world.top = tests::add_volume(world, "world", make_box("world", 1000, 1000, 1000));
  const VolumeId hall = tests::add_volume(world, "hall", make_box("hall", 900, 900, 900));
  tests::place(world, world.top, hall, {0, 0, 0});
  std::map<std::string, VolumeId> leaves{
      {"thin", tests::add_volume(world, "thin", make_box("thin", 1, 50, 50))},
      {"thick", tests::add_volume(world, "thick", make_box("thick", 4, 50, 50))},
      {"wide", tests::add_volume(world, "wide", make_box("wide", 2, 80, 80))},
      {"rod", tests::add_volume(world, "rod", make_tube("rod", 0, 2, 50, 0, 7))}};
  double x = -400;
  for (int i = 0; i < 10; ++i) {
    for (const auto& [name, volume] : leaves) tests::place(world, hall, volume, {x += 15, 0, 0});
  }
  finish(world);
  const Geometry geometry(std::make_shared<const World>(std::move(world)));
  std::vector<VolumeId> volumes;
  for (const std::string& name : hot) volumes.push_back(leaves.at(name));
  return generate(geometry, analyse_world(geometry), volumes, leaves_share);
}

TEST(Module, LeavesOfOneKindInOneMotherShareTheirCode) {
  const Module module = plates_in_a_hall({"thin", "thick", "wide", "rod"}, Leaves::shared);
  ASSERT_EQ(module.entries.size(), 4U);
  std::map<std::string, std::set<const void*>> data;
  for (const Entry& entry : module.entries) data[entry.step].insert(module.data_of(entry));
  ASSERT_EQ(data.size(), 2U);  // of the plates, and of the rod
  std::set<double> thicknesses;
  for (const auto& [step, numbers] : data) {
    if (numbers.size() == 1) continue;
    ASSERT_EQ(numbers.size(), 3U);
    for (const void* of : numbers) {
      const auto* leaf = static_cast<const kernels::SharedLeafData*>(of);
      EXPECT_EQ(leaf->module, module.data);
      thicknesses.insert(reinterpret_cast<const kernels::Box<double>*>(leaf + 1)->hx);
    }
  }
  EXPECT_EQ(thicknesses, (std::set<double>{1, 2, 4}));
  EXPECT_NE(own_text(module).find("LeaveSharedLeafTo<"), std::string::npos);
}

TEST(Module, ALeafByItselfIsConstants) {
  const Module module = plates_in_a_hall({"thin", "rod"}, Leaves::shared);
  ASSERT_EQ(module.entries.size(), 2U);
  EXPECT_NE(module.entries[0].step, module.entries[1].step);
  EXPECT_EQ(own_text(module).find("LeaveSharedLeafTo<"), std::string::npos);
  EXPECT_EQ(module.data_of(module.entries[0]), module.data);
}

TEST(Module, LeavesThatStayApartAreConstants) {
  const Module module = plates_in_a_hall({"thin", "thick", "wide", "rod"}, Leaves::apart);
  std::set<std::string> steps;
  for (const Entry& entry : module.entries) steps.insert(entry.step);
  EXPECT_EQ(steps.size(), 4U);
  EXPECT_EQ(own_text(module).find("LeaveSharedLeafTo<"), std::string::npos);
}

TEST(Module, IsTheSameTextEveryTime) {
  const Geometry a(std::make_shared<const World>(tests::mixed_world()));
  const Geometry b(std::make_shared<const World>(tests::mixed_world()));
  const std::array<VolumeId, 3> hot{0, 1, 2};
  EXPECT_EQ(generate(a, analyse_world(a), hot).source, generate(b, analyse_world(b), hot).source);
}

TEST(Module, HostileNamesStayOutOfTheCode) {
  World world;
  world.top = tests::add_volume(world, "x\n#error pwned\n*/ \"", make_box("b", 1, 1, 1));
  finish(world);
  const Geometry geometry(std::make_shared<const World>(std::move(world)));
  const Module module = generate(geometry, analyse_world(geometry), std::array<VolumeId, 1>{0});
  EXPECT_EQ(module.source.find("#error"), std::string::npos);
}

TEST(KernelTexts, HoldEveryKernelOfEveryKind) {
  for (const std::string_view name : kernel_order())
    EXPECT_FALSE(kernel_text(name).empty()) << name;
  std::vector<const char*> others{"vectors", "prelude", "lanes", "scene", "shared_leaf"};
  others.insert(others.end(), scene_kernels().begin(), scene_kernels().end());
  for (const char* name : others) {
    EXPECT_FALSE(kernel_text(name).empty()) << name;
    EXPECT_EQ(kernel_text(name).find("#include"), std::string_view::npos);
  }
  for (const KindFacts& kind : all_kinds()) {
    for (const char* name : kernels_of(kind.kind)) {
      EXPECT_FALSE(kernel_text(name).empty()) << name;
    }
    // Foreign solids answer by functions of the program; nothing is compiled for them.
    EXPECT_EQ(kernels_of(kind.kind).empty(), kind.kind == SolidKind::foreign) << kind.name;
  }
}

TEST(KernelTexts, StandInTheOrderThatEachSolidNeeds) {
  const std::vector<std::string_view> order = kernel_order();
  for (const KindFacts& kind : all_kinds()) {
    auto at = order.begin();
    for (const std::string_view name : kind.kernel_files) {
      const auto found = std::find(at, order.end(), name);
      ASSERT_NE(found, order.end()) << name << " of " << kind.name << " comes too early";
      at = found;
    }
  }
}

TEST(KernelTexts, EndWhereNavigationDoes) {
  for (const std::string_view name : kernel_order()) {
    const std::string_view text = kernel_text(name);
    EXPECT_EQ(text.find(" normal("), std::string_view::npos) << name;
    EXPECT_TRUE(text.ends_with("}  // namespace navjit::kernels\n")) << name;
  }
}

}  // namespace
}  // namespace navjit::codegen
