#include "codegen/module.hpp"

#include <gtest/gtest.h>

#include <array>
#include <memory>

#include "codegen/kernel_names.hpp"
#include "codegen/kernel_texts.hpp"
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
  for (const char* name : kernel_order()) EXPECT_FALSE(kernel_text(name).empty()) << name;
  for (const char* name : {"vectors", "prelude", "grid", "navigation_stack", "navigation"}) {
    EXPECT_FALSE(kernel_text(name).empty()) << name;
    EXPECT_EQ(kernel_text(name).find("#include"), std::string_view::npos);
  }
  for (int kind = 0; kind <= static_cast<int>(SolidKind::subtraction_of); ++kind) {
    for (const char* name : kernels_of(static_cast<SolidKind>(kind))) {
      EXPECT_FALSE(kernel_text(name).empty()) << name;
    }
    EXPECT_FALSE(kernels_of(static_cast<SolidKind>(kind)).empty());
  }
}

}  // namespace
}  // namespace navjit::codegen
