// Plugins give the same answers as the generic navigator, or are not used.
#include "runtime/plugin.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <random>

#include "jit/compiler.hpp"
#include "runtime/faulty_runtime.hpp"
#include "runtime/make_plugin.hpp"
#include "runtime/overrides.hpp"
#include "runtime/plugin_text.hpp"
#include "runtime/transport.hpp"
#include "tests/support/command.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/traces.hpp"

namespace navjit {
namespace {

namespace fs = std::filesystem;
using tests::TemporaryFolder;

class PluginTest : public testing::Test {
 protected:
  void SetUp() override {
    std::vector<VolumeId> scenes;
    for (VolumeId v = 0; v < geometry_.size(); ++v) scenes.push_back(v);
    source_ = plugin_source(geometry_, analyse_world(geometry_), scenes);
  }

  std::string make(const std::string& source) {
    const std::string path = folder_.file("det.so");
    make_plugin(source, {1}, path);
    return path;
  }

  /// Why loading fails; empty if it does not.
  std::string refusal(const std::string& path) const {
    const auto plugin = Plugin::load(path, geometry_);
    return plugin ? "" : plugin.failure().message;
  }

  /// Transports with the plugin, compares every step, and gives the number of scenes installed.
  std::size_t scenes_in_use(const std::string& path) {
    RuntimeOptions options = tests::eager_options(JitMode::off);
    Runtime generic(world_, options);
    options.plugin = path;
    Runtime runtime(world_, options);
    Navigator a = generic.navigator(), b = runtime.navigator();
    for (const Ray& ray : tests::rays_through(*world_, 21, 400)) {
      EXPECT_TRUE(tests::same_bits(tests::trace(a, ray, world_->tolerance),
                                   tests::trace(b, ray, world_->tolerance)));
    }
    std::size_t specialised = 0;
    for (const SceneReport& scene : runtime.report().scenes) {
      specialised += scene.origin == CodeOrigin::plugin ? 1 : 0;
    }
    return specialised;
  }

  const std::shared_ptr<const World> world_ = std::make_shared<const World>(tests::mixed_world());
  const Geometry geometry_{world_};
  const TemporaryFolder folder_;
  std::string source_;
};

std::string replaced(std::string text, const std::string& old, const std::string& by) {
  const std::size_t at = text.rfind(old);
  if (at == std::string::npos) throw std::logic_error("nothing to replace: " + old);
  return text.replace(at, old.size(), by);
}

TEST_F(PluginTest, IsUsedFromTheStart) {
  const std::string path = make(source_);
  EXPECT_EQ(refusal(path), "");
  EXPECT_GE(scenes_in_use(path), 5U);
  const auto files = fs::directory_iterator(folder_.path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 1) << "nothing else is left in its folder";
}

TEST_F(PluginTest, LosesScenesThatAreSlowerInTheRun) {
  FaultyOptions options;
  static_cast<RuntimeOptions&>(options) = tests::eager_options(JitMode::on);
  options.specialiser.keep_only_faster = true;
  options.specialiser.constants = options.specialiser.structures = false;
  options.specialiser.solids = false;
  options.plugin = make(source_);
  Faults faults;
  faults.lose_trials = true;
  options.faults = std::make_shared<const Faults>(faults);
  FaultyRuntime runtime(world_, options);
  Navigator navigator = runtime.navigator();
  const std::vector<Ray> rays = tests::rays_through(*world_, 21, 400);
  const auto lost = [&] {
    const std::vector<SceneReport> scenes = runtime.report().scenes;
    return std::count_if(scenes.begin(), scenes.end(), [](const SceneReport& scene) {
      return scene.note == "slower in the run than what was there" &&
             scene.status == SceneStatus::unprofitable && scene.origin == CodeOrigin::plugin;
    });
  };
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (lost() < 3 && std::chrono::steady_clock::now() < give_up) {
    for (const Ray& ray : rays) transport(navigator, ray, world_->tolerance);
  }
  EXPECT_GE(lost(), 3);
}

TEST_F(PluginTest, TwoOfThemAreTwo) {
  const std::string first = make(source_);
  fs::rename(first, folder_.file("first.so"));
  const std::string second =
      make(plugin_source(geometry_, analyse_world(geometry_), std::vector<VolumeId>{1}));
  const auto a = Plugin::load(folder_.file("first.so"), geometry_);
  const auto b = Plugin::load(second, geometry_);
  ASSERT_TRUE(a && b);
  EXPECT_NE((*a)->entries().size(), (*b)->entries().size());
}

TEST_F(PluginTest, OneMayGoBeforeAnotherComes) {
  const std::string first = make(source_);
  fs::rename(first, folder_.file("first.so"));
  const std::string second =
      make(plugin_source(geometry_, analyse_world(geometry_), std::vector<VolumeId>{1}));
  // The system's loader knows libraries by names that come again.
  auto a = Plugin::load(folder_.file("first.so"), geometry_);
  const auto same = Plugin::load(folder_.file("first.so"), geometry_);
  ASSERT_TRUE(a && same);
  a = Failure{""};
  const auto b = Plugin::load(second, geometry_);
  ASSERT_TRUE(b);
  EXPECT_EQ((*b)->entries().size(), 1U);
  EXPECT_NE((*same)->entries().size(), 1U);
}

TEST_F(PluginTest, MayBeOverwrittenWhileItIsInUse) {
  const std::string path = make(source_);
  RuntimeOptions options = tests::eager_options(JitMode::off);
  options.plugin = path;
  Runtime runtime(world_, options);
  std::ofstream(path, std::ios::trunc) << "something else";  // in place
  Navigator navigator = runtime.navigator();
  std::size_t steps = 0;
  for (const Ray& ray : tests::rays_through(*world_, 21, 100)) {
    steps += tests::trace(navigator, ray, world_->tolerance).size();
  }
  EXPECT_GT(steps, 100U);
}

TEST_F(PluginTest, DamageIsFoundBeforeItIsLoaded) {
  const std::string path = make(source_);
  const std::string right = tests::read_file(path);
  std::mt19937_64 random(1);
  for (int round = 0; round < 300; ++round) {
    std::string damaged = right;
    // The headers, the seal, and anywhere.
    const std::size_t at = round % 3 == 0   ? random() % 64
                           : round % 3 == 1 ? right.size() - 1 - random() % 48
                                            : random() % right.size();
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << random() % 8));
    tests::write_file(path, damaged);
    EXPECT_NE(refusal(path), "") << at;
    tests::write_file(path, right.substr(0, random() % right.size()));
    EXPECT_NE(refusal(path), "");
  }
  tests::write_file(path, right + "more");
  EXPECT_NE(refusal(path), "");
  EXPECT_EQ(scenes_in_use(path), 0U) << "the run goes on without it";
  tests::write_file(path, right);
  EXPECT_EQ(refusal(path), "");
}

TEST_F(PluginTest, WhatWasMadeForSomethingElseIsRefused) {
  const std::string other_generator =
      replaced(source_, std::string(generator_fingerprint()).substr(0, 8), "01234567");
  EXPECT_NE(refusal(make(other_generator)).find("another version of navjit"), std::string::npos);
  const std::string other_abi = replaced(source_, "= navjit::kernels::abi_version", "= 4000000000");
  EXPECT_NE(refusal(make(other_abi)).find("another version of navjit"), std::string::npos);
  const std::string other_format =
      replaced(source_, "navjit_plugin_format = " + std::to_string(plugin_format),
               "navjit_plugin_format = 7");
  EXPECT_NE(refusal(make(other_format)).find("another version"), std::string::npos);
  const std::string other_tables =
      replaced(source_, "navjit_plugin_hot[] = {0, 1, ", "navjit_plugin_hot[] = {0, 0, ");
  EXPECT_NE(refusal(make(other_tables)).find("its scenes are not those"), std::string::npos);
  const std::string no_scene =
      replaced(source_, "navjit_plugin_hot[] = {0, 1, ", "navjit_plugin_hot[] = {0, 1000000, ");
  EXPECT_NE(refusal(make(no_scene)), "");
  const std::string other_processor = replaced(source_, "navjit_plugin_features[] = \"\"",
                                               "navjit_plugin_features[] = \"avx9000 \"");
  EXPECT_NE(refusal(make(other_processor)).find("a processor with avx9000"), std::string::npos);
  const std::string no_count =
      replaced(source_, "navjit_plugin_count = ", "navjit_plugin_number = ");
  EXPECT_NE(refusal(make(replaced(no_count, "unsigned navjit_plugin_count;",
                                  "unsigned navjit_plugin_number;"))),
            "");
  const std::string too_many =
      replaced(source_, "navjit_plugin_count = ", "navjit_plugin_count = 100000 + ");
  EXPECT_NE(refusal(make(too_many)), "");
  const std::string twice =
      replaced(source_, "navjit_plugin_volumes[] = {0, 1, ", "navjit_plugin_volumes[] = {0, 0, ");
  EXPECT_NE(refusal(make(twice)), "");
  EXPECT_NE(refusal(make("extern \"C\" int other() { return 1; }")).find("no plugin"),
            std::string::npos);
  // Another detector.
  World world = tests::mixed_world();
  world.volumes[2].solid = make_box("plate", 20, 20, 0.5);
  finish(world);
  const auto plugin =
      Plugin::load(make(source_), Geometry(std::make_shared<const World>(std::move(world))));
  ASSERT_FALSE(plugin);
  EXPECT_NE(plugin.failure().message.find("another detector"), std::string::npos);
}

TEST_F(PluginTest, WrongCodeIsFoundByVerification) {
  const std::string right = "  return best;\n";
  std::string wrong = source_;
  for (std::size_t at = 0; (at = wrong.find(right, at)) != std::string::npos; at += 20) {
    wrong.replace(at, right.size(), "  return best * (1 + 0x1p-52);\n");
  }
  EXPECT_EQ(scenes_in_use(make(wrong)), 0U);
}

TEST_F(PluginTest, FilesOfOthersAreRefused) {
  const std::string path = make(source_);
  ASSERT_EQ(chmod(path.c_str(), 0664), 0);
  EXPECT_NE(refusal(path).find("written by others"), std::string::npos);
  ASSERT_EQ(chmod(path.c_str(), 0644), 0);
  ASSERT_EQ(chmod(folder_.path().c_str(), 0777), 0);
  EXPECT_NE(refusal(path).find("written by others"), std::string::npos);
  ASSERT_EQ(chmod(folder_.path().c_str(), 0700), 0);
  EXPECT_EQ(refusal(path), "");
  for (const std::string& none : {folder_.file("none"), folder_.path(), std::string("/dev/null")}) {
    EXPECT_NE(refusal(none), "") << none;
    EXPECT_EQ(scenes_in_use(none), 0U);
  }
}

TEST_F(PluginTest, ThatCannotBeMadeLeavesNothing) {
  EXPECT_THROW(make_plugin(source_, {0}, "/nowhere/det.so"), Error);
  EXPECT_THROW(make_plugin("int broken = ;", {0}, folder_.file("det.so")), Error);
  setenv("NAVJIT_LD", "/nowhere/ld", 1);
  try {
    make_plugin(source_, {0}, folder_.file("det.so"));
    ADD_FAILURE() << "there is no such linker";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("NAVJIT_LD"), std::string::npos) << error.what();
  }
  setenv("NAVJIT_LD", "false", 1);
  EXPECT_THROW(make_plugin(source_, {0}, folder_.file("det.so")), Error);
  unsetenv("NAVJIT_LD");
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(PluginTest, HasTheInstructionsThatAreAskedFor) {
  if (!processor_has("avx2")) GTEST_SKIP() << "this processor has not the second set";
  const auto made = [&](InstructionSet set) {
    const std::string path = folder_.file("det.so");
    make_plugin(source_, {1, set}, path);
    EXPECT_GE(scenes_in_use(path), 5U);
    return tests::read_file(path);
  };
  EXPECT_NE(made(InstructionSet::sse42), made(InstructionSet::avx2));
}

TEST(PluginFeatures, AreThoseOfThisProcessorAndNoOthers) {
  const std::vector<std::string> host = jit::host_features();
  const std::vector<std::string> avoid = features_to_avoid(host);
  for (const std::string& feature : host) {
    const bool avoided = std::find(avoid.begin(), avoid.end(), "-" + feature) != avoid.end();
    EXPECT_TRUE(avoided || feature == "evex512" || processor_has(feature))
        << feature << ": LLVM finds it, and the check of plugins does not";
  }
  EXPECT_FALSE(processor_has("avx9000"));
  EXPECT_FALSE(processor_has(""));
}

TEST_F(PluginTest, WhatTheEnvironmentSwitchesOffIsNotTaken) {
  const std::string path = make(source_);
  setenv(overrides_variable, "*=off", 1);
  EXPECT_EQ(scenes_in_use(path), 0U);
  unsetenv(overrides_variable);
  EXPECT_GE(scenes_in_use(path), 5U);
}

}  // namespace
}  // namespace navjit
