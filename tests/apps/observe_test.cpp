// --observe on the command line.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/command.hpp"
#include "tests/support/folder.hpp"

namespace navjit {
namespace {

using nlohmann::json;
using tests::run_navjit;

/// A hall of air with two trays of air, which hold bricks of lead; one tray is sensitive.
constexpr const char* trays = R"(<gdml>
<materials>
  <material name="air" Z="7"><D value="0.0012"/><atom value="14"/></material>
  <material name="lead" Z="82"><D value="11.35"/><atom value="207.2"/></material>
</materials>
<solids>
  <box name="hall" x="200" y="200" z="200"/><box name="tray" x="40" y="40" z="40"/>
  <box name="brick" x="10" y="10" z="10"/>
</solids>
<structure>
  <volume name="brick"><materialref ref="lead"/><solidref ref="brick"/></volume>
  <volume name="tray"><materialref ref="air"/><solidref ref="tray"/>
    <physvol><volumeref ref="brick"/></physvol></volume>
  <volume name="marked"><materialref ref="air"/><solidref ref="tray"/>
    <physvol><volumeref ref="brick"/></physvol>
    <auxiliary auxtype="SensDet" auxvalue="d"/></volume>
  <volume name="hall"><materialref ref="air"/><solidref ref="hall"/>
    <physvol><volumeref ref="tray"/><position z="-50"/></physvol>
    <physvol><volumeref ref="marked"/><position z="50"/></physvol></volume>
</structure>
<setup name="Default" version="1.0"><world ref="hall"/></setup></gdml>)";

class Observe : public testing::Test {
 protected:
  void SetUp() override { tests::write_file(detector_, trays); }
  std::string trace(const std::string& observe) const {
    const std::string rays = folder_.file("rays.csv"), out = folder_.file("out.csv");
    tests::write_file(rays, "x,y,z,dx,dy,dz\n0,0,-99,0,0,1\n");
    const tests::Output output = run_navjit("trace " + detector_ + " --rays " + rays + " --out " +
                                            out + (observe.empty() ? "" : " --observe " + observe));
    EXPECT_EQ(output.status, 0) << output.text;
    return tests::read_file(out);
  }

  tests::TemporaryFolder folder_;
  std::string detector_ = folder_.file("trays.gdml");
};

TEST_F(Observe, TracesEndWhereMaterialsChange) {
  const std::string head = "ray,step,volume,length\n";
  EXPECT_EQ(trace(""), head +
                           "0,0,hall,29\n0,1,tray,15\n0,2,brick,10\n0,3,tray,15\n0,4,hall,60\n"
                           "0,5,marked,15\n0,6,brick,10\n0,7,marked,15\n0,8,hall,30\n");
  EXPECT_EQ(trace("all"), trace(""));
  EXPECT_EQ(trace("materials"),
            head +
                "0,0,hall,44\n0,1,brick,10\n0,2,hall,75\n0,3,marked,15\n0,4,brick,10\n"
                "0,5,marked,15\n0,6,hall,30\n");
  EXPECT_EQ(trace("materials,tray"), trace(""));
}

TEST_F(Observe, TheReportSaysWhatWasDissolved) {
  const std::string path = folder_.file("report.json");
  const auto report = [&](const std::string& observe) {
    const tests::Output output =
        run_navjit("run " + detector_ + " --rays 500 --observe " + observe + " --report " + path);
    EXPECT_EQ(output.status, 0) << output.text;
    return json::parse(tests::read_file(path));
  };
  const json all = report("all"), materials = report("materials");
  EXPECT_EQ(all["observe"]["kind"], "all");
  const json& observe = materials["observe"];
  EXPECT_EQ(observe["kind"], "materials");
  EXPECT_EQ(observe["invisible"], 1);
  EXPECT_EQ(observe["dissolved"], 1);
  EXPECT_EQ(observe["gone"][0]["volume"], "tray");
  EXPECT_EQ(observe["gone"][0]["mother"], "hall");
  EXPECT_TRUE(observe["left"].empty());
  // The same rays, with fewer steps.
  EXPECT_LT(materials["steps"], all["steps"]);
  EXPECT_NEAR(materials["length_mm"].get<double>(), all["length_mm"].get<double>(), 1e-6);
}

TEST_F(Observe, TheSimplifiedDetectorIsAFile) {
  const std::string simple = folder_.file("simple.gdml"), report = folder_.file("report.json");
  const tests::Output output =
      run_navjit("simplify " + detector_ + " -o " + simple + " --report " + report);
  EXPECT_EQ(output.status, 0) << output.text;
  EXPECT_NE(output.text.find("dissolved tray in hall: 1 placement\n"), std::string::npos)
      << output.text;
  EXPECT_EQ(json::parse(tests::read_file(report))["observe"]["dissolved"], 1);
  const std::string before = trace("materials");
  detector_ = simple;
  EXPECT_EQ(trace("all"), before);
  EXPECT_EQ(trace("materials"), before);
  // Its tags are there, too: the marked tray stays.
  const tests::Output again =
      run_navjit("simplify " + simple + " -o " + folder_.file("again.gdml"));
  EXPECT_EQ(again.status, 0);
  EXPECT_EQ(tests::read_file(folder_.file("again.gdml")), tests::read_file(simple));
  EXPECT_EQ(run_navjit("simplify " + simple).status, 2);
  EXPECT_EQ(run_navjit("simplify " + simple + " -o /nowhere/simple.gdml").status, 1);
}

TEST_F(Observe, AccuracySaysWhatIsLost) {
  const std::string path = folder_.file("accuracy.json");
  const tests::Output output =
      run_navjit("accuracy " + detector_ + " --rays 300 --repetitions 1 --observe materials " +
                 "--observe budget:30 --report " + path);
  EXPECT_EQ(output.status, 0) << output.text;
  const json all = json::parse(tests::read_file(path))["observations"];
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0]["observe"], "all");
  EXPECT_EQ(all[0]["largest_radiation_lengths"], 0);
  EXPECT_LT(all[1]["steps_per_ray"], all[0]["steps_per_ray"]);
  EXPECT_LT(all[1]["largest_radiation_lengths"], 1e-9);
  // The brick of lead in the tray, which is not observed: 17 mm are three radiation lengths.
  EXPECT_EQ(all[2]["observe"], "budget:30");
  EXPECT_GT(all[2]["largest_radiation_lengths"], 1);
  EXPECT_LE(all[2]["largest_radiation_lengths"], all[2]["bound_radiation_lengths"]);
  EXPECT_LE(all[2]["bound_radiation_lengths"], 30);
  EXPECT_EQ(run_navjit("accuracy " + detector_ + " --observe nothing").status, 2);
}

TEST_F(Observe, WrongUsageIsTold) {
  const auto run = [&](const std::string& observe) {
    return run_navjit("run " + detector_ + " --rays 10 --observe " + observe);
  };
  EXPECT_EQ(run("everything").status, 2);
  EXPECT_EQ(run("materials,").status, 2);
  const tests::Output unknown = run("materials,nothing");
  EXPECT_EQ(unknown.status, 1);
  EXPECT_EQ(unknown.text, "navjit: there is no volume 'nothing' to observe\n");
}

}  // namespace
}  // namespace navjit
