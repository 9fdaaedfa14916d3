// Output files are written whole or not at all, and only regular files are ever replaced.
#include "files/output_file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <filesystem>
#include <thread>

#include "navjit/errors.hpp"
#include "tests/support/command.hpp"
#include "tests/support/folder.hpp"

namespace navjit {
namespace {

namespace fs = std::filesystem;
using tests::read_file;
using tests::TemporaryFolder;
using tests::write_file;

std::size_t files_in(const std::string& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

mode_t mode_of(const std::string& path) {
  struct stat status {};
  return lstat(path.c_str(), &status) == 0 ? status.st_mode : 0;
}

TEST(OutputFile, IsThereWhenItIsFinished) {
  const TemporaryFolder folder;
  const std::string path = folder.file("out");
  {
    OutputFile file(path);
    EXPECT_FALSE(fs::exists(path));
    file.write("some");
    file.write(" text");
    EXPECT_FALSE(fs::exists(path));
    file.finish();
    EXPECT_EQ(read_file(path), "some text");
  }
  EXPECT_EQ(read_file(path), "some text");
  EXPECT_EQ(mode_of(path) & 0777, 0644U);
  EXPECT_EQ(files_in(folder.path()), 1U);
  const std::string large(1 << 20, 'x');
  write_output(path, large);
  EXPECT_EQ(read_file(path), large);
}

TEST(OutputFile, LeavesWhatWasThereIfItIsNotFinished) {
  const TemporaryFolder folder;
  const std::string path = folder.file("out");
  write_file(path, "before");
  {
    OutputFile file(path);
    file.write(std::string(1 << 20, 'x'));
  }
  EXPECT_EQ(read_file(path), "before");
  EXPECT_EQ(files_in(folder.path()), 1U);
  { OutputFile file(folder.file("new")); }
  EXPECT_EQ(files_in(folder.path()), 1U);
}

TEST(OutputFile, KeepsPermissions) {
  const TemporaryFolder folder;
  const std::string path = folder.file("out");
  write_file(path, "before");
  fs::permissions(path, fs::perms(0600));
  write_output(path, "after");
  EXPECT_EQ(read_file(path), "after");
  EXPECT_EQ(mode_of(path) & 0777, 0600U);
  OutputFile given(path, 0644);
  given.finish();
  EXPECT_EQ(mode_of(path) & 0777, 0644U);
}

TEST(OutputFile, FollowsLinksAndLeavesThem) {
  const TemporaryFolder folder;
  const std::string target = folder.file("target"), link = folder.file("link");
  write_file(target, "something much longer than what comes");
  fs::create_symlink(target, link);
  {
    OutputFile file(link);
    EXPECT_EQ(read_file(target).size(), 37U) << "what was there stays until there is more";
    file.write("text");
    file.finish();
  }
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(read_file(target), "text");
  fs::remove(target);
  write_output(link, "made");  // a link to nothing
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(read_file(target), "made");
  EXPECT_EQ(files_in(folder.path()), 2U);
}

TEST(OutputFile, DoesNotReplaceDevices) {
  write_output("/dev/null", "text");
  EXPECT_TRUE(S_ISCHR(mode_of("/dev/null")));
  EXPECT_THROW(write_output("/dev/full", "text"), Error);
  EXPECT_TRUE(S_ISCHR(mode_of("/dev/full")));
  const TemporaryFolder folder;
  const std::string device = folder.file("null"), link = folder.file("link");
  if (mknod(device.c_str(), S_IFCHR | 0666, makedev(1, 3)) != 0) GTEST_SKIP() << "no devices";
  fs::create_symlink(device, link);
  for (const std::string& path : {device, link}) {
    try {
      write_output(path, "text");
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("Permission denied"), std::string::npos)
          << "but where devices are not for use: " << error.what();
    }
  }
  EXPECT_TRUE(S_ISCHR(mode_of(device)));
  EXPECT_TRUE(S_ISLNK(mode_of(link)));
}

TEST(OutputFile, WritesIntoPipes) {
  const TemporaryFolder folder;
  const std::string path = folder.file("pipe");
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  std::string text;
  std::jthread reader([&] { text = read_file(path); });
  write_output(path, "text");
  reader.join();
  EXPECT_EQ(text, "text");
  EXPECT_TRUE(S_ISFIFO(mode_of(path)));
}

TEST(OutputFile, TellsAtOnceWhereNothingCanBeWritten) {
  const TemporaryFolder folder;
  const auto why = [](const std::string& path) -> std::string {
    try {
      OutputFile file(path);
      return "opened";
    } catch (const Error& error) {
      return error.what();
    }
  };
  const std::string nowhere = folder.file("no/where");
  EXPECT_EQ(why(nowhere), nowhere + ": cannot be written: No such file or directory");
  EXPECT_EQ(why(folder.path()), folder.path() + ": cannot be written: Is a directory");
  EXPECT_NE(why(""), "opened");
  EXPECT_NE(why(folder.file("file/")), "opened");
  EXPECT_NE(why("/proc/navjit"), "opened");
  write_file(folder.file("file"), "");
  EXPECT_NE(why(folder.file("file/below")), "opened");
  EXPECT_EQ(files_in(folder.path()), 1U);
}

TEST(OutputFile, NamesOfFullLengthAreFine) {
  const TemporaryFolder folder;
  const std::string path = folder.file(std::string(255, 'n'));
  write_output(path, "text");
  EXPECT_EQ(read_file(path), "text");
}

TEST(TemporaryPath, IsRemovedByADyingProcess) {
  const TemporaryFolder folder;
  const int status = tests::in_child([&] {
    OutputFile file(folder.file("out"));
    file.write("text");
    write_file(folder.file("temporary"), "");
    const TemporaryPath path(folder.file("temporary"));
    write_file(folder.file("kept"), "");
    TemporaryPath kept(folder.file("kept"));
    kept.keep();
    remove_temporary_paths();
    _exit(7);
    return 0;
  });
  EXPECT_EQ(WEXITSTATUS(status), 7);
  EXPECT_TRUE(fs::exists(folder.file("kept")));
  EXPECT_EQ(files_in(folder.path()), 1U);
}

}  // namespace
}  // namespace navjit
