// From a profile to production: a program without a compiler runs code that another one compiled.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "runtime/plugin.hpp"
#include "tests/support/command.hpp"
#include "tests/support/folder.hpp"

namespace navjit {
namespace {

namespace fs = std::filesystem;
using tests::run_navjit;
using tests::TemporaryFolder;

const std::string shashlik = NAVJIT_DETECTORS_DIR "/shashlik.gdml";

/// Runs the command that contains no compiler.
tests::Output run_production(const std::string& arguments) {
  return tests::run_command(NAVJIT_PRODUCTION, arguments);
}

TEST(Production, HasNoCompilerInIt) {
  const tests::Output libraries = tests::run_command("ldd", NAVJIT_PRODUCTION);
  ASSERT_EQ(libraries.status, 0) << libraries.text;
  EXPECT_NE(libraries.text.find("libc.so"), std::string::npos);
  EXPECT_EQ(libraries.text.find("LLVM"), std::string::npos) << libraries.text;
  EXPECT_EQ(libraries.text.find("clang"), std::string::npos) << libraries.text;
}

TEST(Production, HasNoReferenceAt113BitsInIt) {
  const tests::Output full = tests::run_command("nm", "-C " NAVJIT_COMMAND);
  const tests::Output lean = tests::run_command("nm", "-C " NAVJIT_PRODUCTION);
  ASSERT_EQ(lean.status, 0) << lean.text;
  EXPECT_NE(full.text.find("WideGeometry"), std::string::npos) << "nm tells nothing";
  EXPECT_EQ(lean.text.find("WideGeometry"), std::string::npos);
  const tests::Output accuracy = run_production("accuracy " + shashlik + " --rays 10");
  EXPECT_EQ(accuracy.status, 1) << accuracy.text;
  EXPECT_NE(accuracy.text.find("113 bits"), std::string::npos) << accuracy.text;
}

TEST(Production, BindsScenesToData) {
  const TemporaryFolder folder;
  const tests::Output output = run_production("run " + shashlik +
                                              " --origin 0,0,0 --eta 2,5 --rays 200 --jit wait "
                                              "--report " +
                                              folder.file("report.json"));
  ASSERT_EQ(output.status, 0) << output.text;
  const auto report = nlohmann::json::parse(std::ifstream(folder.file("report.json")));
  double share = 0;
  for (const auto& scene : report.at("scenes")) {
    if (scene.at("binding") == "data") share += scene.at("share").get<double>();
  }
  EXPECT_GT(share, 0.5) << report.dump(1);
}

TEST(Production, APluginMayBeOfWhatARunObserves) {
  const TemporaryFolder folder;
  const std::string observe = shashlik + " --observe mixtures:10% ";
  const std::string profile = folder.file("p.json"), plugin = folder.file("p.so");
  tests::Output output = run_navjit("run " + observe +
                                    "--origin 0,0,0 --eta 2,5 --rays 300 "
                                    "--cache off --save-profile " +
                                    profile);
  ASSERT_EQ(output.status, 0) << output.text;
  const std::string make = " --emit so -o " + plugin + " --profile " + profile;
  output = run_navjit("specialise " + shashlik + make);
  EXPECT_EQ(output.status, 1) << output.text;
  EXPECT_NE(output.text.find("another observation"), std::string::npos) << output.text;
  output = run_navjit("specialise " + observe + make);
  ASSERT_EQ(output.status, 0) << output.text;
  output = run_production("run " + observe + "--origin 0,0,0 --eta 2,5 --rays 200 --plugin " +
                          plugin + " --report " + folder.file("r.json"));
  ASSERT_EQ(output.status, 0) << output.text;
  const auto report = nlohmann::json::parse(std::ifstream(folder.file("r.json")));
  EXPECT_GT(report.at("plugin_scenes"), 0);
}

TEST(Production, APluginHasEachSceneOnce) {
  const TemporaryFolder folder;
  const std::string plugin = folder.file("p.so");
  std::string scenes;
  for (int i = 0; i < 60; ++i) scenes += " InnerLead";
  tests::Output output =
      run_navjit("specialise " + shashlik + " --emit so -o " + plugin + " --scene" + scenes);
  ASSERT_EQ(output.status, 0) << output.text;
  EXPECT_NE(output.text.find("1 scene\n"), std::string::npos) << output.text;
  output = run_production("run " + shashlik + " --rays 10 --plugin " + plugin);
  EXPECT_EQ(output.text.find("no complete plugin"), std::string::npos) << output.text;
}

TEST(Production, RunsAPluginFromAProfile) {
  const TemporaryFolder folder;
  const std::string source = " --origin 0,0,0 --eta 2,5";
  for (const std::string seed : {"1", "2"}) {
    const tests::Output output =
        run_navjit("run " + shashlik + source + " --rays 200 --jit off --seed " + seed +
                   " --save-profile " + folder.file("p" + seed + ".json"));
    ASSERT_EQ(output.status, 0) << output.text;
  }
  ASSERT_EQ(run_navjit("profile merge " + folder.file("p1.json") + " " + folder.file("p2.json") +
                       " -o " + folder.file("p.json"))
                .status,
            0);
  EXPECT_EQ(nlohmann::json::parse(tests::read_file(folder.file("p.json"))).at("runs"), 2);
  const tests::Output made =
      run_navjit("specialise " + shashlik + " --profile " + folder.file("p.json") +
                 " --least-share 0.05 --opt 1 --emit so -o " + folder.file("det.so"));
  ASSERT_EQ(made.status, 0) << made.text;

  const std::string right = folder.file("right.csv"), got = folder.file("got.csv");
  const std::string rays = "trace " + shashlik + " --rays 300 --out ";
  ASSERT_EQ(run_navjit(rays + right + " --jit off").status, 0);
  for (const char* jit : {"on", "off", "wait", "shadow"}) {
    const tests::Output output =
        run_production(rays + got + " --plugin " + folder.file("det.so") + " --jit " + jit);
    ASSERT_EQ(output.status, 0) << output.text;
    EXPECT_EQ(output.text, "") << "nothing to complain about";
    EXPECT_TRUE(tests::read_file(right) == tests::read_file(got)) << jit;
  }
  const tests::Output run =
      run_production("run " + shashlik + source + " --rays 300 --plugin " + folder.file("det.so") +
                     " --report " + folder.file("report.json"));
  ASSERT_EQ(run.status, 0) << run.text;
  const auto report = nlohmann::json::parse(tests::read_file(folder.file("report.json")));
  EXPECT_GT(report.at("plugin_scenes"), 1);
  EXPECT_EQ(report.at("modules"), 0);
  EXPECT_EQ(report.at("scenes")[0].at("code"), "plugin");
  // A plugin that is refused is a line in the log.
  fs::resize_file(folder.file("det.so"), 1000);
  const tests::Output refused =
      run_production(rays + got + " --jit off --plugin " + folder.file("det.so"));
  EXPECT_EQ(refused.status, 0);
  EXPECT_EQ(std::count(refused.text.begin(), refused.text.end(), '\n'), 1) << refused.text;
  EXPECT_NE(refused.text.find("plugin not used"), std::string::npos) << refused.text;
  EXPECT_TRUE(tests::read_file(right) == tests::read_file(got));
}

TEST(Specialise, TakesTheInstructionsThatAPluginMayUse) {
  const TemporaryFolder folder;
  for (const std::string isa : {"sse4.2", "native"}) {
    const std::string plugin = folder.file(isa + ".so");
    const tests::Output made = run_navjit("specialise " + shashlik + " --scene InnerLead --isa " +
                                          isa + " --emit so -o " + plugin);
    ASSERT_EQ(made.status, 0) << made.text;
    const tests::Output run =
        run_production("run " + shashlik + " --origin 0,0,0 --eta 2,5 --rays 100 --plugin " +
                       plugin + " --report " + folder.file("report.json"));
    ASSERT_EQ(run.status, 0) << run.text;
    const auto report = nlohmann::json::parse(tests::read_file(folder.file("report.json")));
    EXPECT_GT(report.at("plugin_scenes"), 0) << isa;
  }
  if (!processor_has("avx2")) GTEST_SKIP() << "both may be the same";
  EXPECT_NE(tests::read_file(folder.file("sse4.2.so")), tests::read_file(folder.file("native.so")));
}

TEST(Specialise, NamesFromTheFileAreNoCode) {
  const TemporaryFolder folder;
  std::string text = tests::read_file(shashlik);
  const std::string hostile =
      "&quot;; } __attribute__((constructor)) void f() { __builtin_trap(); } /*";
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find("\"InnerLead\"", at)) != std::string::npos; ++count) {
    text.replace(at + 1, 9, hostile);
    at += hostile.size();
  }
  ASSERT_GE(count, 2U);
  tests::write_file(folder.file("hostile.gdml"), text);
  const std::string name = "'\"; } __attribute__((constructor)) void f() { __builtin_trap(); } /*'";
  const tests::Output output =
      run_navjit("specialise " + folder.file("hostile.gdml") + " --scene " + name +
                 " --emit cpp -o " + folder.file("det.cpp"));
  ASSERT_EQ(output.status, 0) << output.text;
  const std::string source = tests::read_file(folder.file("det.cpp"));
  EXPECT_EQ(source.find("constructor))"), std::string::npos);
  EXPECT_NE(source.find("navjit_plugin_volumes"), std::string::npos);
}

TEST(Specialise, SaysWhatIsWrong) {
  const TemporaryFolder folder;
  const std::string so = " --emit so -o " + folder.file("det.so");
  for (const std::string& wrong :
       {std::string("specialise ") + shashlik, "specialise " + shashlik + so,
        "specialise " + shashlik + " --scene A --emit exe -o x",
        "specialise " + shashlik + " --scene A --profile p" + so,
        "specialise " + shashlik + " --scene InnerLead --isa mmx" + so, std::string("profile"),
        std::string("profile merge -o x"), std::string("plugin seal")}) {
    EXPECT_EQ(run_navjit(wrong).status, 2) << wrong;
  }
  tests::write_file(folder.file("p.json"), "{}");
  tests::write_file(folder.file("text"), "no library");
  for (const std::string& wrong :
       {"specialise " + shashlik + " --scene nobody" + so,
        "specialise " + shashlik + " --profile " + folder.file("p.json") + so,
        "specialise " + shashlik + " --profile /nowhere" + so,
        "specialise " + shashlik + " --scene InnerLead --emit cpp -o /nowhere/x",
        "profile merge /nowhere -o " + folder.file("x"), "plugin seal " + folder.file("text"),
        std::string("plugin seal /nowhere")}) {
    const tests::Output output = run_navjit(wrong);
    EXPECT_EQ(output.status, 1) << wrong;
    EXPECT_EQ(std::count(output.text.begin(), output.text.end(), '\n'), 1) << output.text;
  }
}

}  // namespace
}  // namespace navjit
