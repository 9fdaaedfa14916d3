// Includes go one way between the folders ("rooms") of the project (docs/architecture.md).
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

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

/// The same for the rooms within two of them; "geometry" and "apps" are the files that are in none.
const std::map<std::string, std::set<std::string>> allowed_within{
    {"geometry", {}},
    {"geometry/kernels", {}},
    {"geometry/solids", {"geometry/kernels"}},
    {"geometry/model", {"geometry/solids"}},
    {"geometry/bvh", {"geometry/solids"}},
    {"geometry/rays", {"geometry/model"}},
    {"geometry/navigation",
     {"geometry/kernels", "geometry/solids", "geometry/model", "geometry/bvh"}},
    {"geometry/detector", {"geometry/model", "geometry/navigation"}},
    {"geometry/reference", {"geometry/solids", "geometry/model"}},
    {"geometry/check",
     {"geometry/solids", "geometry/model", "geometry/bvh", "geometry/navigation"}},
    {"geometry/gdml", {"geometry", "geometry/solids", "geometry/model"}},
    {"geometry/root", {"geometry", "geometry/solids", "geometry/model"}},
    {"geometry/surface", {"geometry", "geometry/solids", "geometry/bvh"}},
    {"apps", {"apps/options", "apps/mpi"}},
    {"apps/options", {}},
    {"apps/mpi", {}},
    {"apps/accuracy", {"apps", "apps/options"}},
    {"apps/import", {"apps", "apps/options"}},
    {"apps/merge", {"apps", "apps/options"}},
    {"apps/picture", {"apps", "apps/options"}},
    {"apps/scan", {"apps", "apps/options"}},
    {"apps/warmup", {"apps", "apps/options"}},
    {"apps/run",
     {"apps", "apps/options", "apps/mpi", "apps/merge", "apps/picture", "apps/warmup"}}};

struct Include {
  fs::path file;     ///< below the root
  std::string path;  ///< what is included, below the root or below include/
};

/// The folder of a file, or the first `levels` of its folders.
std::string room_of(const fs::path& file, int levels) {
  fs::path room;
  for (const fs::path& part : file.parent_path()) {
    if (levels-- > 0) room /= part;
  }
  return room;
}

/// What the files of a room include of the project.
std::vector<Include> includes_of(const std::string& room) {
  const std::regex include("^ *# *include [\"<]([a-z_]+/[^\">]+)");
  std::vector<Include> found;
  for (const auto& entry : fs::recursive_directory_iterator(root / room)) {
    const std::string extension = entry.path().extension();
    if (extension != ".h" && extension != ".hpp" && extension != ".cpp") continue;
    std::ifstream in(entry.path());
    for (std::string line; std::getline(in, line);) {
      std::smatch match;
      if (!std::regex_search(line, match, include)) continue;
      const std::string other = room_of(match[1].str(), 1);
      const bool ours = allowed.contains(other) || other == "navjit" || other == "tests";
      if (ours) found.push_back({fs::relative(entry.path(), root), match[1]});
    }
  }
  return found;
}

TEST(Rooms, IncludeOneWay) {
  std::size_t includes = 0;
  for (const auto& [room, others] : allowed) {
    for (const Include& include : includes_of(room)) {
      ++includes;
      const std::string other = room_of(include.path, 1);
      EXPECT_TRUE(other == room || others.contains(other)) << include.file << ": " << include.path;
    }
  }
  EXPECT_GT(includes, 500U);
}

TEST(Rooms, IncludeOneWayWithinThem) {
  std::size_t includes = 0;
  for (const std::string outer : {"geometry", "apps"}) {
    for (const Include& include : includes_of(outer)) {
      if (room_of(include.path, 1) != outer) continue;
      ++includes;
      const std::string room = room_of(include.file, 2), other = room_of(include.path, 2);
      const auto others = allowed_within.find(room);
      ASSERT_NE(others, allowed_within.end()) << room << " is not listed here";
      EXPECT_TRUE(other == room || others->second.contains(other))
          << include.file << ": " << include.path;
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
