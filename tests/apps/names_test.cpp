// Names that would break tables and CSV files, or send commands to a terminal.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/text.hpp"
#include "tests/support/command.hpp"
#include "tests/support/folder.hpp"

namespace navjit::tests {
namespace {

constexpr auto npos = std::string::npos;

/// A world with a daughter of this name, which is written as in XML.
std::string detector(const std::string& name) {
  return R"(<?xml version="1.0" encoding="UTF-8"?>
<gdml><define/><materials><material name="M" Z="1"><D value="1"/><atom value="1"/></material></materials>
<solids><box name="b" x="10" y="10" z="10"/><box name="w" x="100" y="100" z="100"/></solids>
<structure>
<volume name=")" +
         name + R"("><materialref ref="M"/><solidref ref="b"/></volume>
<volume name="W"><materialref ref="M"/><solidref ref="w"/>
<physvol name=")" +
         name + R"( placed"><volumeref ref=")" + name + R"("/></physvol>
<physvol><volumeref ref=")" +
         name + R"("/><position name="p" x="3"/></physvol></volume>
</structure><setup name="Default" version="1.0"><world ref="W"/></setup></gdml>
)";
}

class Names : public testing::Test {
 protected:
  std::string det(const std::string& name) {
    write_file(folder_.file("det.gdml"), detector(name));
    write_file(folder_.file("rays.csv"), "x,y,z,dx,dy,dz\n0,0,-20,0,0,1\n");
    return folder_.file("det.gdml");
  }
  TemporaryFolder folder_;
};

/// The rows of a CSV file by RFC 4180.
std::vector<std::vector<std::string>> rows_of(const std::string& text) {
  std::vector<std::vector<std::string>> rows(1, {""});
  bool in_quotes = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"' && in_quotes && i + 1 < text.size() && text[i + 1] == '"') {
      rows.back().back() += text[++i];
    } else if (c == '"') {
      in_quotes = !in_quotes;
    } else if (c == ',' && !in_quotes) {
      rows.back().emplace_back();
    } else if (c == '\n' && !in_quotes) {
      rows.push_back({""});
    } else {
      rows.back().back() += c;
    }
  }
  rows.pop_back();
  return rows;
}

TEST_F(Names, AreQuotedInTraces) {
  const std::pair<const char*, const char*> cases[]{{"a,b", "a,b"},
                                                    {"say &quot;x&quot;", "say \"x\""},
                                                    {"two&#10;lines", "two\nlines"},
                                                    {"&#13;", "\r"},
                                                    {"&#xe9;", "\u00e9"}};
  for (const auto& [xml, name] : cases) {
    const Output output =
        run_navjit("trace " + det(xml) + " --jit off --rays " + folder_.file("rays.csv"));
    ASSERT_EQ(output.status, 0) << output.text;
    const auto rows = rows_of(output.text);
    ASSERT_EQ(rows.size(), 4U) << output.text;
    for (const auto& row : rows) EXPECT_EQ(row.size(), 4U) << output.text;
    EXPECT_EQ(rows[2][2], name);
  }
}

TEST_F(Names, DoNotSteerTheTerminal) {
  const std::string file = det("evil&#x9b;2J&#10;&#x202e;x");
  for (const std::string command :
       {"inspect FILE", "run FILE --rays 200 --jit off", "check FILE --resolution 100",
        "run FILE --rays 200 --jit off --budget 1e-6",
        "accuracy FILE --rays 400 --repetitions 1 --boundaries 0 --vecgeom off"}) {
    std::string line = command;
    line.replace(line.find("FILE"), 4, file);
    const Output output = run_navjit(line);
    EXPECT_NE(output.text.find("evil\\u{9b}2J\\n\\u{202e}x"), npos) << command << output.text;
    EXPECT_EQ(output.text.find("\u009b"), npos) << command << ": " << output.text;
    EXPECT_EQ(output.text.find("\u202e"), npos) << command << ": " << output.text;
    EXPECT_EQ(output.text.find("2J\n"), npos) << command << ": " << output.text;
  }
  // Reports for programs have them as they are.
  const Output output =
      run_navjit("run " + file + " --rays 200 --jit off --report " + folder_.file("r.json"));
  ASSERT_EQ(output.status, 0);
  bool found = false;
  const auto report = nlohmann::json::parse(read_file(folder_.file("r.json")));
  for (const auto& scene : report.at("scenes")) {
    found = found || scene.at("volume") == "evil\u009b2J\n\u202ex";
  }
  EXPECT_TRUE(found) << report;
}

TEST_F(Names, AreOneLineInErrors) {
  const std::string file = det("a&#10;b&#x9b;");
  std::string text = read_file(file);
  text.replace(text.find("solidref ref=\"b\""), 16, "solidref ref=\"c&#10;d\"");
  write_file(file, text);
  const Output output = run_navjit("inspect " + file);
  EXPECT_EQ(output.status, 1);
  EXPECT_EQ(std::count(output.text.begin(), output.text.end(), '\n'), 1) << output.text;
}

TEST_F(Names, KeepTheColumnsOfTables) {
  for (const std::string name :
       {"short", "\u00e9\u00e9\u00e9\u00e9\u00e9\u00e9", "\u4e2d\u4e2d\u4e2d",
        "0123456789012345678901234567890123456789012345678901234567890123",
        "\u4e2d\u4e2d\u4e2d\u4e2d\u4e2d\u4e2d\u4e2d\u4e2d\u4e2d\u4e2d\u4e2d\u4e2d"
        "\u4e2d\u4e2d\u4e2d\u4e2d\u4e2d\u4e2d\u4e2d\u4e2d\u4e2d\u4e2d\u4e2d"}) {
    const Output output = run_navjit("run " + det(name) + " --rays 500 --jit off");
    ASSERT_EQ(output.status, 0) << output.text;
    std::istringstream lines(output.text);
    std::size_t at = 0, rows = 0;
    for (std::string line; std::getline(lines, line);) {
      const std::size_t percent = line.find("% ");
      if (percent == npos) continue;
      const std::size_t column = common::columns(line.substr(0, percent));
      if (rows++ == 0) at = column;
      EXPECT_EQ(column, at) << output.text;
    }
    EXPECT_EQ(rows, 2U) << output.text;
  }
}

}  // namespace
}  // namespace navjit::tests
