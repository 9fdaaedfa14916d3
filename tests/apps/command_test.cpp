// The command as users meet it: reports, exit statuses, and one clear line for each error.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/command.hpp"
#include "tests/support/folder.hpp"

namespace navjit {
namespace {

using tests::run_navjit;
using tests::write_file;

namespace fs = std::filesystem;

const std::string shashlik = NAVJIT_DETECTORS_DIR "/shashlik.gdml";

class Folder : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / ("command_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  fs::path folder_;
};

using Notes = Folder;

TEST_F(Notes, AreLoggedOnceWithFileAndLine) {
  write_file(file("odd.gdml"),
             "<gdml>\n<define><variable name='i' value='0'/>\n<loop for='i' from='2' to='1' "
             "step='-1'/></define><solids><box name='b' x='9' y='9' z='9'/></solids><structure>"
             "<volume name='W'><materialref ref='G4_AIR'/><solidref ref='b'/></volume></structure>"
             "<setup name='s' version='1'><world ref='W'/></setup></gdml>");
  for (const std::string command : {"run --rays 10 ", "trace --rays 2 ", "check ", "inspect "}) {
    const tests::Output output = run_navjit(command + file("odd.gdml"));
    EXPECT_EQ(output.status, 0) << output.text;
    const std::string note = file("odd.gdml") + ":3: <loop for='i'>: a loop that counts down";
    const auto at = output.text.find(note);
    EXPECT_NE(at, std::string::npos) << output.text;
    EXPECT_EQ(output.text.find(note, at + 1), std::string::npos) << output.text;
  }
}

using RunCommand = Folder;

TEST_F(RunCommand, WritesAReportOfWhatHappened) {
  for (const std::string jit : {"on", "off", "wait"}) {
    const tests::Output output =
        run_navjit("run " + shashlik + " --origin 0,0,0 --eta 2,5 --rays 3000 --threads 2 --jit " +
                   jit + " --report " + file("report.json"));
    ASSERT_EQ(output.status, 0) << output.text;
    const auto report = nlohmann::json::parse(tests::read_file(file("report.json")));
    EXPECT_EQ(report.at("rays"), 3000);
    EXPECT_GT(report.at("steps"), 100000);
    EXPECT_EQ(report.at("stuck"), 0);
    EXPECT_GT(report.at("length_mm"), 1e6);
    EXPECT_GT(report.at("seconds"), 0);
    EXPECT_GT(report.at("steps_per_second"), 0);
    EXPECT_GT(report.at("warm_steps_per_second"), 0);
    EXPECT_FALSE(report.contains("level")) << "there is one";
    EXPECT_EQ(report.at("threads"), 2);
    ASSERT_GT(report.at("scenes").size(), 3U);
    double share = 0;
    std::uint64_t steps = 0;
    for (const auto& scene : report.at("scenes")) {
      for (const char* key :
           {"volume", "steps", "share", "generic_ns_per_step", "specialised_ns_per_step",
            "compile_ms", "specialised_at_s", "swapped_at_s"}) {
        EXPECT_TRUE(scene.contains(key)) << key;
      }
      share += scene.at("share").get<double>();
      steps += scene.at("steps").get<std::uint64_t>();
    }
    EXPECT_NEAR(share, 1, 1e-9);
    EXPECT_EQ(steps, report.at("steps"));
    const std::string& hottest = report.at("scenes")[0].at("volume");
    EXPECT_NE(output.text.find(hottest), std::string::npos) << "the table names the hot scene";
    EXPECT_GT(report.at("scenes")[0].at("generic_ns_per_step"), 0);
    EXPECT_TRUE(jit != "wait" || report.at("scenes")[0].at("specialised_ns_per_step") > 0);
  }
}

TEST_F(RunCommand, TotalsDoNotDependOnThreads) {
  std::vector<nlohmann::json> reports;
  for (const char* threads : {"1", "3"}) {
    ASSERT_EQ(run_navjit("run " + shashlik + " --rays 2000 --threads " + threads + " --report " +
                         file("r.json"))
                  .status,
              0);
    reports.push_back(nlohmann::json::parse(tests::read_file(file("r.json"))));
  }
  EXPECT_EQ(reports[0].at("steps"), reports[1].at("steps"));
  EXPECT_EQ(reports[0].at("length_mm"), reports[1].at("length_mm"));
}

TEST(Inspect, ShowsVolumesAndTheAnalysisOfAScene) {
  const tests::Output all = run_navjit("inspect " + shashlik);
  EXPECT_EQ(all.status, 0);
  EXPECT_NE(all.text.find("touchables"), std::string::npos);
  EXPECT_NE(all.text.find("InnerLead"), std::string::npos);
  const tests::Output structures = run_navjit("inspect " + shashlik + " --structures");
  EXPECT_EQ(structures.status, 0);
  EXPECT_NE(structures.text.find(" structures\n"), std::string::npos) << structures.text;
  EXPECT_NE(structures.text.find("unrotated box, slabs of boxes"), std::string::npos)
      << structures.text;
  const tests::Output scene = run_navjit("inspect " + shashlik + " --scene InnerLead --emit");
  EXPECT_EQ(scene.status, 0);
  EXPECT_NE(scene.text.find("candidates   grid: cells"), std::string::npos) << scene.text;
  EXPECT_NE(scene.text.find("navjit_step_"), std::string::npos);
}

TEST(Inspect, TellsWhatIsOddInWhateverItShows) {
  const tests::TemporaryFolder folder;
  const std::string file = folder.file("odd.gdml");
  tests::write_file(file, R"(<gdml><materials>
<material name="air" Z="7"><D value="0.0012"/><atom value="14"/></material></materials><solids>
<box name="a" x="9" y="9" z="9"/><box name="b" x="1" y="1" z="1"/></solids><structure>
<volume name="B"><materialref ref="air"/><solidref ref="b"/></volume>
<volume name="A"><materialref ref="air"/><solidref ref="a"/>
<physvol copynumber="many"><volumeref ref="B"/></physvol></volume></structure>
<setup name="s" version="1"><world ref="A"/></setup></gdml>
)");
  for (const std::string option : {"", " --scene B", " --structures"}) {
    const tests::Output output = run_navjit("inspect " + file + option);
    EXPECT_EQ(output.status, 0) << output.text;
    EXPECT_NE(output.text.find("copynumber"), std::string::npos) << output.text;
  }
}

TEST(Inspect, ShowsWhoSharesTheCode) {
  const std::string argon = NAVJIT_DETECTORS_DIR "/argon.gdml";
  const std::string says = "shared with 1 equal volume: ";
  const tests::Output one = run_navjit("inspect " + argon + " --scene Wire_3");
  EXPECT_NE(one.text.find(says + "Wire_984\n"), std::string::npos) << one.text;
  const tests::Output other = run_navjit("inspect " + argon + " --scene Wire_984");
  EXPECT_NE(other.text.find(says + "Wire_3\n"), std::string::npos) << other.text;
  const tests::Output alone = run_navjit("inspect " + shashlik + " --scene InnerLead");
  EXPECT_EQ(alone.text.find("equal volume"), std::string::npos) << alone.text;
}

TEST(Inspect, ShowsTheBoxStructure) {
  const std::string inspect = "inspect " + shashlik + " --boxes ";
  const tests::Output all = run_navjit(inspect + "regular-tree:furthest");
  EXPECT_EQ(all.status, 0) << all.text;
  EXPECT_NE(all.text.find("regular-tree:furthest"), std::string::npos);
  const tests::Output scene =
      run_navjit(inspect + "linear,InnerLead=two-level:k-means --scene InnerLead");
  EXPECT_EQ(scene.status, 0) << scene.text;
  EXPECT_NE(scene.text.find("two-level:k-means, 2 clusters"), std::string::npos) << scene.text;
  const tests::Output nobody = run_navjit(inspect + "nobody=linear");
  EXPECT_EQ(nobody.status, 1) << nobody.text;
  EXPECT_NE(nobody.text.find("'nobody'"), std::string::npos) << nobody.text;
}

TEST(Inspect, ShowsDensityAndRadiationLength) {
  const tests::Output output = run_navjit("inspect " + shashlik);
  EXPECT_EQ(output.status, 0);
  EXPECT_NE(output.text.find("     g/cm3      X0/cm material\n"), std::string::npos) << output.text;
  // The Review of Particle Physics has 0.5612 cm for lead, and 41.3 cm for polystyrene of 1.06
  // g/cm3.
  const auto row = [&](const std::string& material) {
    std::istringstream lines(output.text);
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      double density = 0, length = 0;
      std::string name;
      if (words >> density >> length >> name && name == material) return std::pair(density, length);
    }
    return std::pair(0.0, 0.0);
  };
  EXPECT_EQ(row("Lead").first, 11.35) << output.text;
  EXPECT_NEAR(row("Lead").second, 0.5612, 0.002) << output.text;
  EXPECT_EQ(row("Polystyrene").first, 1.05) << output.text;
  EXPECT_NEAR(row("Polystyrene").second, 41.3 * 1.06 / 1.05, 0.5) << output.text;
}

TEST(Usage, WrongUsageIsStatusTwo) {
  for (const char* arguments :
       {"", "fly", "run", "run x.gdml --jit sometimes", "run x.gdml --level exact",
        "run x.gdml --rays many", "run x.gdml --rays 0", "run x.gdml --origin 1,2",
        "run x.gdml --eta nan,2", "run x.gdml --threads 0", "trace x.gdml",
        "run x.gdml --boxes tree", "run x.gdml --boxes linear:surface"}) {
    const tests::Output output = run_navjit(arguments);
    EXPECT_EQ(output.status, 2) << arguments << ": " << output.text;
    EXPECT_EQ(std::count(output.text.begin(), output.text.end(), '\n'), 1) << output.text;
  }
  EXPECT_EQ(run_navjit("--help").status, 0);
  EXPECT_EQ(run_navjit("run --help").status, 0);
}

using BadInput = Folder;

/// A GDML file with these solids and this structure.
std::string gdml(const std::string& solids, const std::string& structure) {
  return "<?xml version=\"1.0\"?>\n<gdml>\n<define/>\n<materials>\n<material name=\"M\" Z=\"1\"><D "
         "value=\"1\"/><atom value=\"1\"/></material>\n</materials>\n<solids>\n" +
         solids + "\n</solids>\n<structure>\n" + structure +
         "\n</structure>\n<setup name=\"Default\" version=\"1.0\"><world "
         "ref=\"W\"/></setup>\n</gdml>\n";
}

std::string volume(const std::string& name, const std::string& solid,
                   const std::string& daughters = "") {
  return "<volume name=\"" + name + "\"><materialref ref=\"M\"/><solidref ref=\"" + solid + "\"/>" +
         daughters + "</volume>\n";
}

using Setups = Folder;

TEST_F(Setups, AreChosenByName) {
  std::string text =
      gdml("<box name=\"b\" x=\"10\" y=\"10\" z=\"10\"/>", volume("V", "b") + volume("W", "b"));
  const auto end = text.find("</gdml>");
  text.insert(end, "<setup name=\"other\" version=\"1.0\"><world ref=\"V\"/></setup>\n");
  write_file(file("two.gdml"), text);
  const auto last_line = [&](const std::string& options) {
    const tests::Output output = run_navjit("trace " + file("two.gdml") + " --rays 1" + options);
    EXPECT_EQ(output.status, 0) << output.text;
    return output.text.substr(output.text.find('\n') + 1);
  };
  EXPECT_EQ(last_line("").substr(0, 6), "0,0,W,");
  EXPECT_EQ(last_line(" --setup other").substr(0, 6), "0,0,V,");
  for (const char* command : {"inspect ", "run ", "check "}) {
    const tests::Output output = run_navjit(command + file("two.gdml") + " --setup nowhere");
    EXPECT_EQ(output.status, 1) << command;
    EXPECT_NE(output.text.find("setup 'nowhere' is not defined; choose one of 'Default', 'other'"),
              std::string::npos)
        << output.text;
  }
}

TEST_F(BadInput, GivesOneLineWithFileLineAndElement) {
  struct Case {
    const char* what;
    std::string text;
    std::vector<std::string> mentions;
  };
  const std::string box = "<box name=\"b\" x=\"10\" y=\"10\" z=\"10\"/>";
  const std::vector<Case> cases{
      {"truncated", gdml(box, volume("W", "b")).substr(0, 200), {"bad.gdml:"}},
      {"unknown solid", gdml(box, volume("W", "c")), {"bad.gdml:", "solidref", "c"}},
      {"unsupported solid",
       gdml("<blob name=\"b\" x=\"10\"/>", volume("W", "b")),
       {"bad.gdml:8", "blob"}},
      {"not finite",
       gdml("<box name=\"b\" x=\"1/0\" y=\"10\" z=\"10\"/>", volume("W", "b")),
       {"bad.gdml:8", "box"}},
      {"negative",
       gdml("<box name=\"b\" x=\"-1\" y=\"10\" z=\"10\"/>", volume("W", "b")),
       {"bad.gdml:8", "box"}},
      {"cyclic",
       gdml(box, volume("A", "b", "<physvol><volumeref ref=\"W\"/></physvol>") +
                     volume("W", "b", "<physvol><volumeref ref=\"A\"/></physvol>")),
       {"bad.gdml:"}},
      {"empty", "", {"bad.gdml"}},
      {"garbage",
       std::string("\x7f"
                   "ELF\0\1\2\3",
                   8),
       {"bad.gdml:"}},
  };
  for (const Case& c : cases) {
    write_file(file("bad.gdml"), c.text);
    for (const char* command : {"inspect ", "run "}) {
      const tests::Output output = run_navjit(command + file("bad.gdml"));
      EXPECT_EQ(output.status, 1) << c.what << ": " << output.text;
      EXPECT_EQ(std::count(output.text.begin(), output.text.end(), '\n'), 1)
          << c.what << ": " << output.text;
      for (const std::string& mention : c.mentions) {
        EXPECT_NE(output.text.find(mention), std::string::npos) << c.what << ": " << output.text;
      }
    }
  }
}

TEST_F(BadInput, MissingAndUnreadableFiles) {
  for (const std::string& path : {file("none.gdml"), folder_.string(), std::string("/dev/null")}) {
    const tests::Output output = run_navjit("run " + path);
    EXPECT_EQ(output.status, 1) << output.text;
    EXPECT_EQ(std::count(output.text.begin(), output.text.end(), '\n'), 1) << output.text;
    EXPECT_NE(output.text.find(path), std::string::npos) << output.text;
  }
  EXPECT_EQ(run_navjit("inspect " + shashlik + " --scene nobody").status, 1);
  EXPECT_EQ(run_navjit("run " + shashlik + " --rays 10 --report /nowhere/report.json").status, 1);
  EXPECT_EQ(run_navjit("trace " + shashlik + " --rays 10 --out /nowhere/steps.csv").status, 1);
}

TEST_F(BadInput, RaysHaveToBeNumbers) {
  for (const char* text : {"", "a,b\n", "x,y,z,dx,dy,dz\n", "x,y,z,dx,dy,dz\n1,2,3\n",
                           "x,y,z,dx,dy,dz\n1,2,3,0,0,0\n", "x,y,z,dx,dy,dz\nnan,2,3,0,0,1\n",
                           "x,y,z,dx,dy,dz\n1,2,3,0,0,1,9\n", "x,y,z,dx,dy,dz\n1,2,3,0,inf,1\n"}) {
    write_file(file("rays.csv"), text);
    const tests::Output output = run_navjit("trace " + shashlik + " --rays " + file("rays.csv"));
    EXPECT_EQ(output.status, 1) << text;
    EXPECT_NE(output.text.find("rays.csv"), std::string::npos) << output.text;
  }
}

TEST(ShippedDetectors, HaveNoOverlaps) {
  int found = 0;
  for (const auto& entry : fs::directory_iterator(NAVJIT_DETECTORS_DIR)) {
    if (entry.path().extension() != ".gdml") continue;
    ++found;
    const tests::Output output = run_navjit("check " + entry.path().string() + " --resolution 50");
    EXPECT_EQ(output.status, 0) << output.text;
  }
  EXPECT_EQ(found, 5);
}

}  // namespace
}  // namespace navjit
