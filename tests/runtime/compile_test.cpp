// What happens while the compiler works, and what it is given.
#include "runtime/compile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <future>
#include <random>
#include <thread>

#include "codegen/module_text.hpp"
#include "tests/support/traces.hpp"

namespace navjit {
namespace {

/// Sends rays across the world at these heights.
void transport_across(Runtime& runtime, double low, double high, int rays) {
  Navigator navigator = runtime.navigator();
  std::mt19937_64 random(5);
  for (int i = 0; i < rays; ++i) {
    const Vec3 from{-99, tests::uniform(random, low, high), tests::uniform(random, -40, 40)};
    const Vec3 to{99, tests::uniform(random, low, high), tests::uniform(random, -40, 40)};
    const Vec3 along = to - from;
    transport(navigator, {from, (1 / norm(along)) * along}, runtime.world().tolerance);
  }
}

bool is_bound(const Runtime& runtime, const std::string& volume) {
  const RuntimeReport report = runtime.report();
  return std::any_of(report.scenes.begin(), report.scenes.end(), [&](const SceneReport& scene) {
    return scene.volume == volume && scene.binding == Binding::data;
  });
}

TEST(Compile, WhatBecomesHotIsBoundToDataWhileTheCompilerWorks) {
  std::promise<void> begun, released;
  FaultyOptions options{tests::eager_options(JitMode::on)};
  options.faults = std::make_shared<const Faults>(
      Faults{.compiling = [&begun, once = std::make_shared<std::atomic<bool>>(false),
                           go = released.get_future().share()] {
        if (!once->exchange(true)) begun.set_value();
        go.wait();
      }});
  FaultyRuntime runtime(tests::mixed_world(), options);
  transport_across(runtime, -55, -25, 400);
  begun.get_future().wait();
  EXPECT_FALSE(is_bound(runtime, "turned"));
  transport_across(runtime, 20, 80, 2000);
  // Here it would hang if nothing were done until the compiler is.
  while (!is_bound(runtime, "turned")) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  EXPECT_EQ(runtime.report().modules, 0U);
  released.set_value();
  runtime.wait_until_idle();
  EXPECT_GT(runtime.report().modules, 0U);
}

TEST(Compile, TheCommonTextOfModulesIsWholeAndKept) {
  jit::CompileOptions options;
  options.preamble = codegen::common_text();
  auto compiler = jit::Compiler::create(options);
  ASSERT_TRUE(compiler) << compiler.failure().message;
  for (int i = 0; i < 3; ++i) {
    const std::string source =
        codegen::common_text() + "extern \"C\" int one() { return " + std::to_string(i) + "; }\n";
    const auto object = compiler->compile(source, "navjit_module");
    ASSERT_TRUE(object) << object.failure().message;
    EXPECT_EQ(object->warnings, "");
    EXPECT_EQ(object->report.kept_preamble, i > 0);
  }
}

}  // namespace
}  // namespace navjit
