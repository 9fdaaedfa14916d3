// The public headers include nothing but one another and the standard library. (That each compiles
// by itself is checked where the tests are built.)
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "navjit/navjit.hpp"
#include "tests/support/command.hpp"

namespace navjit {
namespace {

namespace fs = std::filesystem;

const fs::path headers = fs::path(NAVJIT_SOURCE_DIR) / "include" / "navjit";

/// The names that a header includes, with their quotes or angle brackets.
std::set<std::string> includes_of(const fs::path& path) {
  std::set<std::string> found;
  std::ifstream in(path);
  const std::string start = "#include ";
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with(start)) found.insert(line.substr(start.size()));
  }
  return found;
}

TEST(PublicHeaders, IncludeNothingElse) {
  std::size_t count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(headers)) {
    if (!entry.is_regular_file()) continue;
    ++count;
    for (const std::string& name : includes_of(entry.path())) {
      // Names of the standard library's headers have neither folders nor suffixes.
      const bool standard = name.front() == '<' && name.find_first_of("./") == std::string::npos;
      EXPECT_TRUE(standard || name.starts_with("\"navjit/")) << entry.path() << ": " << name;
    }
  }
  EXPECT_GT(count, 15U);
}

TEST(PublicHeaders, AreAllBehindTheOne) {
  const std::set<std::string> all = includes_of(headers / "navjit.hpp");
  for (const auto& entry : fs::directory_iterator(headers)) {
    const std::string name = entry.path().filename();
    // The two that others include for what is in them.
    if (name == "navjit.hpp" || name == "solid_kind.hpp" || name == "search.hpp") continue;
    if (!entry.is_regular_file()) continue;
    EXPECT_TRUE(all.contains("\"navjit/" + name + "\"")) << name;
  }
}

TEST(Version, IsOneForMacrosAndLibrary) {
  EXPECT_EQ(std::string(version()), NAVJIT_VERSION);
  EXPECT_EQ(std::string(NAVJIT_VERSION), std::to_string(NAVJIT_VERSION_MAJOR) + "." +
                                             std::to_string(NAVJIT_VERSION_MINOR) + "." +
                                             std::to_string(NAVJIT_VERSION_PATCH));
}

TEST(Errors, AreOneFamily) {
  const auto throws_error = [](const auto& call) {
    try {
      call();
    } catch (const Error& error) {
      return std::string(error.what()).find('\n') == std::string::npos;
    }
    return false;
  };
  EXPECT_TRUE(throws_error([] { read_gdml("/nowhere.gdml"); }));
  EXPECT_TRUE(throws_error([] { make_box("box", -1, 1, 1); }));
  EXPECT_TRUE(throws_error([] { read_profile("/nowhere.json"); }));
  EXPECT_TRUE(throws_error([] { DetectorBuilder().build(0); }));
}

}  // namespace
}  // namespace navjit
