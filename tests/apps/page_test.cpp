// `navjit run --html`: the page needs no other file, whatever names the detector has.
#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <stdexcept>

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

/// A world with a box whose name would be a script.
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
  std::string page_of(const std::string& arguments) { return page_by("run " + arguments); }
  std::string page_by(const std::string& command) {
    const Output output = run_navjit(command + " --html " + file_);
    EXPECT_EQ(output.status, 0) << output.text;
    return read_file(file_);
  }
  std::string page_of_accuracy() {
    return page_by("accuracy " NAVJIT_DETECTORS_DIR
                   "/absorber.gdml --rays 60 --repetitions 1 --boundaries 500 --vecgeom off");
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
  const std::string page = page_by("warmup " NAVJIT_DETECTORS_DIR
                                   "/absorber.gdml --seconds 0.2 --repetitions 1 --modes cold");
  EXPECT_EQ(count(page, "<polyline"), 4U);
  EXPECT_NE(page.find("speed-up in the end"), npos);
  EXPECT_EQ(page.find("://"), npos);
  EXPECT_EQ(page.find("nan"), npos);
}

TEST_F(Page, OfAnAccuracyHasItsTables) {
  const std::string page = page_of_accuracy();
  EXPECT_EQ(count(page, "<polyline"), 4U) << "two engines in two charts";
  EXPECT_EQ(count(page, "<circle"), 6U);
  for (const char* part : {"generic", "exact", "By scene", "The worst steps", "off the surface",
                           "--rays 60", "100%", "drift at the end, mm"}) {
    EXPECT_NE(page.find(part), npos) << part;
  }
  EXPECT_EQ(page.find("://"), npos);
  EXPECT_EQ(count(page, ">nan"), 0U);
  EXPECT_EQ(count(page, "<tr>"), count(page, "</tr>"));

  const std::string observed =
      page_by("accuracy " NAVJIT_DETECTORS_DIR
              "/absorber.gdml --rays 60 --repetitions 1 --observe materials");
  EXPECT_NE(observed.find("<td>materials</td>"), npos);
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

/// Opens a page in chromium, with a script of the test added. Returns what the script has put into
/// the attribute data-said of the page's body; nothing if chromium does not run here.
std::optional<std::string> said_in_browser(std::string page, const std::string& script,
                                           const TemporaryFolder& folder) {
  page.replace(page.find("</body>"), 7, "<script>" + script + "</script></body>");
  write_file(folder.file("probed.html"), page);
  const Output shown =
      run_command("timeout 100 chromium",
                  "--headless --no-sandbox --disable-gpu --enable-logging=stderr "
                  "--window-size=1200,900 "
                  "--user-data-dir=" +
                      folder.file("profile") + " --dump-dom file://" + folder.file("probed.html"));
  // What it shows has the probe's text; without that it showed nothing.
  if (shown.text.find("data-said") == npos) return std::nullopt;
  const std::size_t at = shown.text.find("data-said=\"");
  if (at == npos) throw std::runtime_error("the probe failed: " + shown.text);
  EXPECT_EQ(shown.text.find(":CONSOLE"), npos) << shown.text;
  return shown.text.substr(at + 11, shown.text.find('>', at) - at - 11);
}

bool there_is_a_browser() { return std::system("command -v chromium > /dev/null 2>&1") == 0; }

TEST_F(Page, WorksInABrowser) {
  if (!there_is_a_browser()) GTEST_SKIP() << "no chromium";
  write_hostile(folder_.file("det.gdml"));
  // Sorts by scene, then by steps twice, and tells what came first.
  const auto said = said_in_browser(page_of(folder_.file("det.gdml") + " --rays 3000"), R"(
    const heads = document.querySelectorAll("table.sorts th button");
    const first = () => document.querySelector("table.sorts tbody td").textContent;
    let said = "";
    for (const i of [0, 2, 2]) { heads[i].click(); said += "[" + first() + "]"; }
    document.body.setAttribute("data-said", said + document.title);
  )",
                                    folder_);
  if (!said) GTEST_SKIP() << "chromium does not run here";
  EXPECT_NE(said->find("navjit run: "), npos) << *said;  // the title is as it was
  // By name, and by steps both ways round.
  std::vector<std::string> first;
  for (std::size_t from = said->find('['); from != npos; from = said->find('[', from + 1)) {
    first.push_back(said->substr(from + 1, said->find(']', from) - from - 1));
  }
  ASSERT_EQ(first.size(), 3U) << *said;
  EXPECT_NE(first[0].find("script"), npos) << *said;
  EXPECT_NE(first[1], first[2]) << *said;
  EXPECT_TRUE(first[1] == "W" || first[2] == "W") << *said;
}

TEST_F(Page, OfAnAccuracyWorksInABrowser) {
  if (!there_is_a_browser()) GTEST_SKIP() << "no chromium";
  const std::string page = page_of_accuracy();
  // The table of scenes by steps, both ways round; and whether a chart's text lies in its frame,
  // and no table is wider than the page, as on a screen so on paper.
  const auto said = said_in_browser(page, R"(
    const tables = [...document.querySelectorAll("table.sorts")];
    const scenes = tables.find(t => t.tHead.textContent.startsWith("scene"));
    const steps = () => [...scenes.tBodies[0].rows].map(r => Number(r.cells[2].dataset.v));
    const falls = list => list.every((v, i) => i === 0 || list[i - 1] >= v);
    const head = scenes.tHead.querySelectorAll("button")[2];
    head.click();
    const down = falls(steps());
    head.click();
    const up = falls(steps().reverse());
    const charts = [...document.querySelectorAll("svg")];
    const inside = charts.every(svg => {
      const box = svg.getBoundingClientRect();
      return [...svg.querySelectorAll("text, circle, polyline")].every(e => {
        const r = e.getBoundingClientRect();
        return r.left >= box.left - 1 && r.right <= box.right + 1 && r.top >= box.top - 1 &&
               r.bottom <= box.bottom + 1;
      });
    });
    const fits = tables.every(t => t.offsetWidth <= t.parentElement.clientWidth + 1);
    document.body.setAttribute("data-said", [down, up, charts.length, inside, fits].join(" "));
  )",
                                    folder_);
  if (!said) GTEST_SKIP() << "chromium does not run here";
  EXPECT_TRUE(said->starts_with("true true 2 true true")) << *said;
}

}  // namespace
}  // namespace navjit::tests
