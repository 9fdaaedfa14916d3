// `navjit run --html`: a page that needs nothing else, whatever the names in the detector are.
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/support/folder.hpp"
#include "tests/support/process.hpp"

namespace navjit::tests {
namespace {

constexpr auto npos = std::string::npos;

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = 0; (at = text.find(what, at)) != npos; at += what.size()) ++found;
  return found;
}

/// A world with a box in it of a name that would be a script.
void write_hostile(const std::string& path) {
  const std::string name = "&lt;script&gt;document.title=&apos;owned&apos;&lt;/script&gt;";
  write_file(path, R"(<?xml version="1.0" encoding="UTF-8"?>
<gdml><define/><materials><material name="M" Z="1"><D value="1"/><atom value="1"/></material></materials>
<solids><box name="b" x="50" y="50" z="50"/><box name="w" x="100" y="100" z="100"/></solids>
<structure><volume name=")" +
                       name + R"("><materialref ref="M"/><solidref ref="b"/></volume>
<volume name="W"><materialref ref="M"/><solidref ref="w"/><physvol><volumeref ref=")" +
                       name + R"("/></physvol></volume>
</structure><setup name="Default" version="1.0"><world ref="W"/></setup></gdml>
)");
}

class Page : public testing::Test {
 protected:
  std::string page_of(const std::string& arguments) {
    const Output output = run_navjit("run " + arguments + " --html " + file_);
    EXPECT_EQ(output.status, 0) << output.text;
    return read_file(file_);
  }
  TemporaryFolder folder_;
  std::string file_ = folder_.file("page.html");
};

TEST_F(Page, TellsWhatTheRunWasLike) {
  for (const std::string jit : {"on", "off"}) {
    const std::string page =
        page_of(NAVJIT_DETECTORS_DIR "/absorber.gdml --rays 20000 --jit " + jit);
    EXPECT_TRUE(page.starts_with("<!DOCTYPE html>"));
    for (const char* part : {"20,000", "What was hot", "Speed against time", "ns/step",
                             "Command and machine", "--rays 20000"}) {
      EXPECT_NE(page.find(part), npos) << jit << ": " << part;
    }
    // A machine with too much else to do may have no time for the rest.
    EXPECT_TRUE(page.find("<polyline") != npos || page.find("too short") != npos);
    EXPECT_EQ(page.find("Where the time goes") != npos, page.find("image/png") != npos);
    EXPECT_EQ(page.find("://"), npos) << "nothing from elsewhere";
    EXPECT_EQ(count(page, "<tr>"), count(page, "</tr>"));
  }
}

TEST_F(Page, NamesAreNoMarkup) {
  write_hostile(folder_.file("det.gdml"));
  const std::string page = page_of(folder_.file("det.gdml") + " --rays 3000");
  EXPECT_NE(page.find("&lt;script&gt;document.title=&#39;owned"), npos);
  EXPECT_EQ(count(page, "<script>"), 1U);
}

TEST_F(Page, OfAWarmUpHasItsCurves) {
  const Output output = run_navjit("warmup " NAVJIT_DETECTORS_DIR
                                   "/absorber.gdml --seconds 0.2 --repetitions 1 --modes cold "
                                   "--html " +
                                   file_);
  ASSERT_EQ(output.status, 0) << output.text;
  const std::string page = read_file(file_);
  EXPECT_EQ(count(page, "<polyline"), 4U);
  EXPECT_NE(page.find("speed-up in the end"), npos);
  EXPECT_EQ(page.find("://"), npos);
  EXPECT_EQ(page.find("nan"), npos);
}

TEST_F(Page, OfAnInterruptedRunIsWritten) {
  Process run({NAVJIT_COMMAND, "run", NAVJIT_DETECTORS_DIR "/absorber.gdml", "--rays", "1e9",
               "--jit", "off", "--html", file_},
              folder_.file("log"));
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  run.send(SIGINT);
  EXPECT_EQ(run.wait(), 128 + SIGINT) << run.text();
  EXPECT_NE(read_file(file_).find("(interrupted)"), npos);
}

TEST_F(Page, WorksInABrowser) {
  if (std::system("command -v chromium > /dev/null 2>&1") != 0) GTEST_SKIP() << "no chromium";
  write_hostile(folder_.file("det.gdml"));
  std::string page = page_of(folder_.file("det.gdml") + " --rays 3000");
  // Sorts by scene, then by steps twice, and tells what came first.
  const std::string probe = R"(<script>
    const heads = document.querySelectorAll("table.sorts th button");
    const first = () => document.querySelector("table.sorts tbody td").textContent;
    let said = "";
    for (const i of [0, 2, 2]) { heads[i].click(); said += "[" + first() + "]"; }
    document.body.setAttribute("data-said", said + document.title);
  </script></body>)";
  page.replace(page.find("</body>"), 7, probe);
  write_file(folder_.file("probed.html"), page);
  const Output shown = run_command("timeout 100 chromium",
                                   "--headless --no-sandbox --disable-gpu --enable-logging=stderr "
                                   "--user-data-dir=" +
                                       folder_.file("profile") + " --dump-dom file://" +
                                       folder_.file("probed.html"));
  const std::size_t at = shown.text.find("data-said=\"");
  // What it shows has the probe's text; without that it showed nothing.
  if (shown.text.find("data-said") == npos) {
    GTEST_SKIP() << "chromium does not run here: " << shown.text.substr(0, 400);
  }
  ASSERT_NE(at, npos) << "the probe failed: " << shown.text;
  EXPECT_EQ(shown.text.find(":CONSOLE"), npos) << shown.text;
  const std::string said = shown.text.substr(at, shown.text.find('>', at) - at);
  EXPECT_NE(said.find("navjit run: "), npos) << said;  // the title is as it was
  // By name, and by steps both ways round.
  std::vector<std::string> first;
  for (std::size_t from = said.find('['); from != npos; from = said.find('[', from + 1)) {
    first.push_back(said.substr(from + 1, said.find(']', from) - from - 1));
  }
  ASSERT_EQ(first.size(), 3U) << said;
  EXPECT_NE(first[0].find("script"), npos) << said;
  EXPECT_NE(first[1], first[2]) << said;
  EXPECT_TRUE(first[1] == "W" || first[2] == "W") << said;
}

}  // namespace
}  // namespace navjit::tests
