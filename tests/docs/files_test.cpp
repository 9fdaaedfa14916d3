// Documents name files: each file that they name has to exist.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

namespace navjit {
namespace {

namespace fs = std::filesystem;

const fs::path root = NAVJIT_SOURCE_DIR;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<fs::path> documents() {
  std::vector<fs::path> files{root / "README.md", root / "CONTRIBUTING.md",
                              root / "bench" / "README.md"};
  for (const auto& entry : fs::recursive_directory_iterator(root / "docs")) {
    if (entry.path().extension() == ".md") files.push_back(entry.path());
  }
  return files;
}

/// What the first group of `pattern` matches, for all matches in `text`.
std::vector<std::string> matches(const std::string& text, const std::string& pattern) {
  const std::regex expression(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), expression), end; it != end; ++it) {
    found.push_back((*it)[1]);
  }
  return found;
}

/// Whether a path exists, as it is or as the stem of source files.
bool is_there(const fs::path& path) {
  if (fs::exists(path)) return true;
  return fs::exists(path.string() + ".cpp") || fs::exists(path.string() + ".hpp");
}

TEST(Documents, NameFilesThatAreThere) {
  std::size_t named = 0;
  for (const fs::path& document : documents()) {
    for (const std::string& name :
         matches(text_of(document),
                 "`((?:analysis|apps|bench|cache|cmake|codegen|common|docs|examples|files|geometry|"
                 "include|jit|python|runtime|scripts|tests)/[A-Za-z0-9_./]*[A-Za-z0-9_/])`")) {
      ++named;
      EXPECT_TRUE(is_there(root / name)) << document << " names " << name;
    }
  }
  EXPECT_GT(named, 60U);
}

TEST(Documents, LinkToFilesThatAreThere) {
  std::size_t links = 0;
  for (const fs::path& document : documents()) {
    for (const std::string& target :
         matches(text_of(document), R"(\]\(([^)#:]+\.(?:md|svg))(?:#[^)]*)?\))")) {
      ++links;
      EXPECT_TRUE(fs::exists(document.parent_path() / target))
          << document << " links to " << target;
    }
  }
  EXPECT_GT(links, 40U);
}

TEST(Documents, AreAllReachedFromTheReadme) {
  const std::string readme = text_of(root / "README.md");
  for (const fs::path& document : documents()) {
    if (document.parent_path() != root / "docs") continue;
    EXPECT_NE(readme.find("docs/" + document.filename().string()), std::string::npos) << document;
  }
}

}  // namespace
}  // namespace navjit
