// Includes go one way between the folders ("rooms") of the project (docs/architecture.md).
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace navjit {
namespace {

namespace fs = std::filesystem;

const fs::path root = NAVJIT_SOURCE_DIR;

/// What each room may include besides itself.
const std::map<std::string, std::set<std::string>> allowed{
    {"geometry", {"navjit"}},
    {"observe", {"navjit", "geometry"}},
    {"analysis", {"navjit", "geometry"}},
    {"codegen", {"navjit", "geometry", "analysis"}},
    {"jit", {"navjit"}},
    {"cache", {"navjit"}},
    {"files", {"navjit"}},
    {"runtime", {"navjit", "geometry", "analysis", "codegen", "jit", "cache", "files"}},
    {"adapters", {"navjit"}},
    {"common", {"navjit", "geometry", "jit", "files", "runtime"}},
    {"apps",
     {"navjit", "geometry", "observe", "analysis", "codegen", "jit", "cache", "files", "runtime",
      "common"}},
    {"bench",
     {"navjit", "geometry", "observe", "analysis", "codegen", "jit", "files", "runtime", "common"}},
    {"examples", {"navjit"}},
    {"python", {"navjit"}}};

TEST(Rooms, IncludeOneWay) {
  const std::regex include("^#include [\"<]([a-z]+)/");
  std::size_t includes = 0;
  for (const auto& [room, others] : allowed) {
    for (const auto& entry : fs::recursive_directory_iterator(root / room)) {
      const std::string extension = entry.path().extension();
      if (extension != ".h" && extension != ".hpp" && extension != ".cpp") continue;
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);) {
        std::smatch match;
        if (!std::regex_search(line, match, include)) continue;
        const std::string other = match[1];
        if (!allowed.contains(other) && other != "navjit") continue;  // the system's
        ++includes;
        EXPECT_TRUE(other == room || others.contains(other)) << entry.path() << ": " << line;
      }
    }
  }
  EXPECT_GT(includes, 500U);
}

TEST(Rooms, TheJitKnowsNoPartsOfTheDetector) {
  // Of the public headers it takes what every room may have, and no more.
  const std::regex include("^#include \"navjit/([a-z_/.]+)\"");
  for (const std::string room : {"jit", "cache", "files"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / room)) {
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);) {
        std::smatch match;
        if (!std::regex_search(line, match, include)) continue;
        EXPECT_TRUE(match[1] == "errors.hpp" || match[1] == "detail/expected.hpp")
            << entry.path() << ": " << line;
      }
    }
  }
}

}  // namespace
}  // namespace navjit
