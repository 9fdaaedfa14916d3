// Which directories and files are trusted.
#include "cache/trust.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/support/command.hpp"
#include "tests/support/folder.hpp"

namespace navjit::cache {
namespace {

namespace fs = std::filesystem;
using navjit::tests::TemporaryFolder;

TEST(Trust, MakesWhatIsMissingForTheUserAlone) {
  const TemporaryFolder folder;
  EXPECT_FALSE(open_trusted_directory(folder.file("a/b"), false));
  ASSERT_TRUE(open_trusted_directory(folder.file("a//b/./c/"), true));
  for (const char* part : {"a", "a/b", "a/b/c"}) {
    struct stat status;
    ASSERT_EQ(stat(folder.file(part).c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 07777, 0700U) << part;
  }
  ASSERT_TRUE(open_trusted_directory(folder.file("a/b/c"), true)) << "and again";
}

TEST(Trust, RefusesWhatOthersCanWriteAnywhereOnTheWay) {
  const TemporaryFolder folder;
  fs::create_directories(folder.file("a/b/c"));
  for (const char* part : {"a", "a/b", "a/b/c"}) {
    for (const mode_t mode : {0720, 0702, 0777}) {
      ASSERT_EQ(chmod(folder.file(part).c_str(), mode), 0);
      const auto refused = open_trusted_directory(folder.file("a/b/c"), true);
      ASSERT_FALSE(refused) << part << " " << mode;
      EXPECT_NE(refused.failure().message.find(folder.file(part) + " can be written by others"),
                std::string::npos)
          << refused.failure().message;
    }
    ASSERT_EQ(chmod(folder.file(part).c_str(), 0755), 0);
    EXPECT_TRUE(open_trusted_directory(folder.file("a/b/c"), true));
  }
}

TEST(Trust, TheStickyBitServesAboveAndNotForTheDirectoryItself) {
  const TemporaryFolder folder;
  fs::create_directories(folder.file("tmp/mine"));
  ASSERT_EQ(chmod(folder.file("tmp").c_str(), 01777), 0);
  EXPECT_TRUE(open_trusted_directory(folder.file("tmp/mine"), false));
  EXPECT_FALSE(open_trusted_directory(folder.file("tmp"), false));
}

TEST(Trust, LinksLeadToWhereTheyLead) {
  const TemporaryFolder folder;
  fs::create_directories(folder.file("open/inner"));
  fs::create_directories(folder.file("private"));
  fs::create_directory_symlink(folder.file("open/inner"), folder.file("private/link"));
  EXPECT_TRUE(open_trusted_directory(folder.file("private/link"), false));
  ASSERT_EQ(chmod(folder.file("open").c_str(), 0777), 0);
  EXPECT_FALSE(open_trusted_directory(folder.file("private/link"), false));
  fs::create_directory_symlink(folder.file("private/loop"), folder.file("private/loop"));
  EXPECT_FALSE(open_trusted_directory(folder.file("private/loop"), true));
}

TEST(Trust, ADirectoryForEverybodyIsNotToBeChanged) {
  const TemporaryFolder folder;
  ASSERT_EQ(chmod(folder.path().c_str(), 01777), 0);
  const auto refused = open_trusted_directory(folder.path(), false);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.failure().message.find("mkdir -m 700"), std::string::npos);
  EXPECT_EQ(refused.failure().message.find("chmod"), std::string::npos);
}

TEST(Trust, FilesAreReadWholeOrNotAtAll) {
  const TemporaryFolder folder;
  const std::string name = folder.file("file");
  EXPECT_FALSE(open_trusted_file(name));
  navjit::tests::write_file(name, "0123456789");
  ASSERT_EQ(chmod(name.c_str(), 0644), 0);
  const auto file = open_trusted_file(name);
  ASSERT_TRUE(file) << file.failure().message;
  EXPECT_EQ(read_all(*file, 10)->size(), 10U);
  EXPECT_FALSE(read_all(*file, 9));
  ASSERT_EQ(chmod(name.c_str(), 0664), 0);
  const auto refused = open_trusted_file(name);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.failure().message.find(name), std::string::npos);
  ASSERT_EQ(chmod(name.c_str(), 0644), 0);
  ASSERT_EQ(chmod(folder.path().c_str(), 0777), 0);
  EXPECT_FALSE(open_trusted_file(name)) << "its directory can be written by others";
}

TEST(Trust, NamesThatAreNone) {
  EXPECT_FALSE(open_trusted_directory("", true));
  EXPECT_FALSE(open_trusted_directory(std::string("a\0b", 3), true));
  EXPECT_FALSE(open_trusted_directory("/dev/null", true));
  EXPECT_FALSE(open_trusted_directory("/dev/null/x", true));
  EXPECT_FALSE(open_trusted_file("/dev/null"));
  EXPECT_FALSE(open_trusted_file(""));
}

}  // namespace
}  // namespace navjit::cache
