// A run in parts: each part is a process of its own, and their reports are merged into one.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/command.hpp"
#include "tests/support/folder.hpp"

namespace navjit {
namespace {

using nlohmann::json;
using tests::run_navjit;

class Parts : public testing::Test {
 protected:
  std::string file(const std::string& name) const { return folder_.file(name); }
  /// The report of a run with these options.
  json run(const std::string& name, const std::string& options) const {
    const tests::Output output = run_navjit("run " NAVJIT_DETECTORS_DIR "/absorber.gdml --report " +
                                            file(name) + " " + options);
    EXPECT_EQ(output.status, 0) << output.text;
    return json::parse(tests::read_file(file(name)));
  }
  tests::Output merge(const std::string& files) const {
    std::string all;
    std::istringstream names(files);
    for (std::string name; names >> name;) all += file(name) + " ";
    return run_navjit("report merge " + all + "-o " + file("all.json"));
  }
  std::string refusal(const std::string& files) const {
    const tests::Output output = merge(files);
    EXPECT_EQ(output.status, 1) << output.text;
    EXPECT_TRUE(output.text.starts_with("navjit: ")) << output.text;
    return output.text;
  }
  tests::TemporaryFolder folder_;
};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(Parts, MakeTheRaysOfTheWholeRun) {
  for (const std::string& rays : {std::string("1003"), file("rays.csv")}) {
    if (rays != "1003") {
      std::string text = "x,y,z,dx,dy,dz\n";
      for (int i = 0; i < 501; ++i) {
        text += "0,0,0," + std::to_string(i % 7 - 3) + "," + std::to_string(i % 5) + ",1\n";
      }
      tests::write_file(rays, text);
    }
    const std::string same = "--jit off --rays " + rays;
    const json whole = run("whole.json", same);
    std::uint64_t rays_made = 0, steps = 0;
    double length = 0;
    std::string files;
    for (int part = 1; part <= 4; ++part) {
      const std::string name = "part" + std::to_string(part) + ".json";
      const json r = run(name, same + " --part " + std::to_string(part) + "/4");
      EXPECT_EQ(r["part"], std::to_string(part) + "/4");
      const auto made = r["rays"].get<std::uint64_t>();
      EXPECT_TRUE(made == whole["rays"].get<std::uint64_t>() / 4 ||
                  made == whole["rays"].get<std::uint64_t>() / 4 + 1);
      rays_made += made;
      steps += r["steps"].get<std::uint64_t>();
      length += r["length_mm"].get<double>();
      files += name + " ";
    }
    EXPECT_EQ(rays_made, whole["rays"]);
    EXPECT_EQ(steps, whole["steps"]);
    EXPECT_NEAR(length, whole["length_mm"].get<double>(), 1e-9 * length);

    const tests::Output output = merge(files);
    ASSERT_EQ(output.status, 0) << output.text;
    EXPECT_FALSE(contains(output.text, "missing"));
    const json all = json::parse(tests::read_file(file("all.json")));
    EXPECT_EQ(all["steps"], whole["steps"]);
    EXPECT_EQ(all["rays"], whole["rays"]);
    EXPECT_EQ(all["merged"], 4);
    EXPECT_TRUE(all["speedup"].is_null()) << "nothing was compared";
    ASSERT_EQ(all["scenes"].size(), whole["scenes"].size());
    std::map<std::string, std::uint64_t> by_volume;
    for (const json& scene : whole["scenes"]) by_volume[scene["volume"]] = scene["steps"];
    double share = 0;
    for (const json& scene : all["scenes"]) {
      EXPECT_EQ(scene["steps"], by_volume[scene["volume"]]);
      share += scene["share"].get<double>();
    }
    EXPECT_NEAR(share, 1, 1e-9);
  }
}

TEST_F(Parts, OfFewRaysMayBeEmpty) {
  std::uint64_t rays = 0;
  for (int part = 1; part <= 5; ++part) {
    rays += run("p.json", "--jit off --rays 3 --part " + std::to_string(part) + "/5")["rays"]
                .get<std::uint64_t>();
  }
  EXPECT_EQ(rays, 3U);
}

TEST_F(Parts, OfWhichNoneIsSpecialisedHaveASpeedUpOfOne) {
  for (int part = 1; part <= 2; ++part) {
    const std::string number = std::to_string(part);
    const json r = run(number + ".json", "--cache off --rays 4 --part " + number + "/2");
    ASSERT_EQ(r.at("speedup"), 1.0);
  }
  ASSERT_EQ(merge("1.json 2.json").status, 0);
  const json all = json::parse(tests::read_file(file("all.json")));
  EXPECT_EQ(all.at("speedup"), 1.0);
  EXPECT_TRUE(all.at("compared").is_null());
}

TEST_F(Parts, MissingOnesAreSaid) {
  run("a.json", "--jit off --rays 100 --part 1/3");
  run("c.json", "--jit off --rays 100 --part 3/3");
  const tests::Output output = merge("c.json a.json");
  EXPECT_EQ(output.status, 0);
  EXPECT_TRUE(contains(output.text, "1 of 3 parts are missing, the first of them 2"))
      << output.text;
}

TEST_F(Parts, WhatDoesNotGoTogetherIsRefused) {
  run("a.json", "--jit off --rays 100 --part 1/3");
  run("other.json", "--jit off --rays 100 --part 2/4");
  run("whole.json", "--jit off --rays 100");
  run("on.json", "--jit on --cache off --rays 100 --part 2/3");
  EXPECT_TRUE(contains(refusal("a.json a.json"), "part 1 is there twice"));
  for (const std::string rays :
       {"--rays 90", "--rays 100 --seed 2", "--rays 100 --origin 0,0,0", "--rays 100 --aim auto"}) {
    run("of_others.json", "--jit off --part 2/3 " + rays);
    EXPECT_TRUE(contains(refusal("a.json of_others.json"), "merge parts of one run")) << rays;
  }
  run("alike.json", "--jit off --rays 1e2 --seed 1 --part 2/3");
  EXPECT_EQ(merge("a.json alike.json").status, 0) << "the same rays in other words";
  EXPECT_TRUE(contains(refusal("a.json other.json"), "of 4 parts"));
  EXPECT_TRUE(contains(refusal("a.json whole.json"), "of a whole run"));
  EXPECT_TRUE(contains(refusal("a.json on.json"), "--jit"));
  EXPECT_TRUE(contains(refusal("a.json none.json"), "no such file"));
  const json good = json::parse(tests::read_file(file("a.json")));
  const auto broken = [&](const json& report) {
    tests::write_file(file("b.json"), report.dump());
    return refusal("b.json");
  };
  EXPECT_TRUE(contains(broken(json::array()), "no report"));
  EXPECT_TRUE(contains(broken(json::object()), "is missing"));
  for (const char* key : {"rays", "steps", "scenes", "length_mm", "detector", "part"}) {
    for (const json& wrong : {json(nullptr), json(-1), json(json::array({1})), json("x")}) {
      if (std::string(key) == "detector" && wrong.is_string()) continue;
      if (std::string(key) == "scenes" && wrong.is_array()) continue;
      json report = good;
      report[key] = wrong;
      EXPECT_TRUE(contains(broken(report), "b.json: ")) << key << wrong;
    }
  }
  json report = good;
  report["steps"] = 1e300;
  broken(report);
  report = good;
  report["interrupted"] = "yes";
  EXPECT_TRUE(contains(broken(report), "b.json: 'interrupted' is neither true nor false"));
  report = good;
  report["scenes"][0].erase("volume");
  broken(report);
  tests::write_file(file("b.json"), "{\"rays\": ");
  refusal("b.json");
}

TEST_F(Parts, WrongOnesAreWrongUsage) {
  for (const char* part :
       {"0/3", "4/3", "1", "1/", "/3", "1/0", "-1/3", "1/x", "1/3/5", "1.5/3", "1/9999999999999"}) {
    const tests::Output output = run_navjit(
        "run " NAVJIT_DETECTORS_DIR "/absorber.gdml --rays 10 --part " + std::string(part));
    EXPECT_EQ(output.status, 2) << part << output.text;
  }
}

}  // namespace
}  // namespace navjit
