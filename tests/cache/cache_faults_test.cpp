// Writers that die, disks that are full, directories that cannot be written: an entry is right or
// missing, and no rubbish collects.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/file.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <csignal>
#include <random>

#include "cache/object_cache.hpp"
#include "tests/support/folder.hpp"

namespace navjit::cache {
namespace {

namespace fs = std::filesystem;
using navjit::tests::files_in;
using navjit::tests::in_child;
using navjit::tests::TemporaryFolder;

constexpr uid_t nobody = 65534;

Digest key(int number) { return sha256({std::to_string(number)}); }

/// Content that tells its key, so that content of another key is noticed.
std::string content(int number) {
  return std::string(200000, static_cast<char>('a' + number % 26));
}

bool is_right(const CacheHit& hit, int number) {
  return hit.content && std::string(hit.content->begin(), hit.content->end()) == content(number);
}

TEST(CacheFaults, KilledWritersLeaveNothingWrongAndNoLitter) {
  const TemporaryFolder folder;
  std::mt19937_64 random(7);
  int killed_while_writing = 0;
  for (int round = 0; round < 120; ++round) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      auto cache = ObjectCache::open(folder.path());
      for (int i = 0; cache; ++i) cache->store(key(i % 5), "", content(i % 5));
      _exit(1);
    }
    usleep(static_cast<useconds_t>(500 + random() % 6000));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    killed_while_writing += files_in(folder.path()) > 6 ? 1 : 0;
    auto cache = ObjectCache::open(folder.path());
    ASSERT_TRUE(cache);
    for (int i = 0; i < 5; ++i) {
      const CacheHit hit = cache->load(key(i));
      EXPECT_EQ(hit.rejected, "");
      EXPECT_TRUE(!hit.content || is_right(hit, i));
    }
    EXPECT_FALSE(cache->store(key(5), "", content(5)));
    ASSERT_LE(files_in(folder.path()), 6U) << "what a killed writer leaves, the next one removes";
  }
  auto cache = ObjectCache::open(folder.path());
  EXPECT_FALSE(cache->store(key(0), "", content(0)));
  EXPECT_LE(files_in(folder.path()), 6U);
  RecordProperty("killed_while_writing", killed_while_writing);
}

TEST(CacheFaults, AnUnfinishedFileOfALivingWriterStays) {
  const TemporaryFolder folder;
  const std::string name = folder.file("unfinished-0123456789abcdef");
  const int file = ::open(name.c_str(), O_WRONLY | O_CREAT, 0600);
  ASSERT_EQ(flock(file, LOCK_EX), 0);
  auto cache = ObjectCache::open(folder.path());
  ASSERT_FALSE(cache->store(key(1), "", "x"));
  EXPECT_TRUE(fs::exists(name));
  close(file);
  ASSERT_FALSE(cache->store(key(1), "", "x"));
  EXPECT_FALSE(fs::exists(name));
}

TEST(CacheFaults, TwoHundredProcessesShareACache) {
  const TemporaryFolder folder;
  std::vector<pid_t> children;
  for (int n = 0; n < 200; ++n) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      // Three of the eight fit: there is eviction all the time.
      auto cache = ObjectCache::open(folder.path(), {.max_bytes = 700000});
      int wrong = cache ? 0 : 1;
      for (int i = 0; cache && i < 12; ++i) {
        const int k = (n + i) % 8;
        const CacheHit hit = cache->load(key(k));
        wrong += !hit.rejected.empty() || (hit.content && !is_right(hit, k)) ? 1 : 0;
        if (!hit.content) wrong += cache->store(key(k), "", content(k)) ? 1 : 0;
      }
      _exit(wrong == 0 ? 0 : 1);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  }
  auto cache = ObjectCache::open(folder.path(), {.max_bytes = 700000});
  EXPECT_FALSE(cache->store(key(1), "", content(1)));
  EXPECT_LE(files_in(folder.path()), 3U);
  const auto entries = cache->list(true);
  for (const CacheEntry& entry : *entries) EXPECT_EQ(entry.problem, "");
}

TEST(CacheFaults, TheLimitOfFileSizesIsAFailureAndNoSignal) {
  const TemporaryFolder folder;
  const int status = in_child([&] {
    const rlimit limit{100000, 100000};
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) return 2;
    auto cache = ObjectCache::open(folder.path());
    const auto failure = cache->store(key(1), "", content(1));
    if (!failure || failure->message.find("ulimit") == std::string::npos) return 3;
    return cache->store(key(2), "", "short") ? 4 : 0;
  });
  EXPECT_EQ(status, 0);
  EXPECT_EQ(files_in(folder.path()), 1U);
}

/// Runs `work` in a child with a file system of 256 kB of its own at `folder`. Returns 0 if `work`
/// returned 0, and 77 if the system does not allow the test to mount one.
template <class Work>
int on_small_disk(const std::string& folder, Work&& work) {
  return in_child([&] {
    if (unshare(CLONE_NEWNS) != 0 && unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return 77;
    mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr);
    if (mount("none", folder.c_str(), "tmpfs", 0, "size=256k,mode=0700") != 0) return 77;
    return work();
  });
}

TEST(CacheFaults, AFullDiskIsAFailureAndLeavesNoLitter) {
  const TemporaryFolder folder;
  const int status = on_small_disk(folder.path(), [&] {
    auto cache = ObjectCache::open(folder.path());
    if (!cache) return 2;
    if (cache->store(key(0), "", content(0))) return 3;
    for (int i = 1; i < 20; ++i) {
      if (!cache->store(key(i), "", content(i))) return 4;
    }
    if (files_in(folder.path()) != 1) return 5;
    return is_right(cache->load(key(0)), 0) ? 0 : 6;
  });
  if (WEXITSTATUS(status) == 77) GTEST_SKIP() << "no file system can be mounted here";
  EXPECT_EQ(status, 0);
}

TEST(CacheFaults, AReadOnlyFileSystemServesWhatItHas) {
  const TemporaryFolder folder;
  const int status = on_small_disk(folder.path(), [&] {
    if (ObjectCache::open(folder.path())->store(key(0), "", content(0))) return 2;
    if (mount("none", folder.path().c_str(), nullptr, MS_REMOUNT | MS_RDONLY, nullptr) != 0) {
      return 77;
    }
    auto cache = ObjectCache::open(folder.path());
    if (!cache) return 3;
    if (!is_right(cache->load(key(0)), 0)) return 4;
    if (!cache->store(key(1), "", "x")) return 5;
    cache->discard(key(0));
    return ObjectCache::open(folder.path() + "/new") ? 6 : 0;
  });
  if (WEXITSTATUS(status) == 77) GTEST_SKIP() << "no file system can be mounted here";
  EXPECT_EQ(status, 0);
}

TEST(CacheFaults, ADirectoryWithoutPermissionToWriteServesWhatItHas) {
  const TemporaryFolder folder;
  const std::string inner = folder.file("cache");
  ASSERT_EQ(chmod(folder.path().c_str(), 0755), 0);
  ASSERT_FALSE(ObjectCache::open(inner)->store(key(0), "", content(0)));
  const auto user_reads = [&] {
    auto cache = ObjectCache::open(inner);
    if (!cache) return 3;
    if (!is_right(cache->load(key(0)), 0)) return 4;
    return cache->store(key(1), "", "x") ? 0 : 5;
  };
  if (geteuid() == 0) {
    // Nothing is read-only for root; another user reads what root provides.
    ASSERT_EQ(chmod(inner.c_str(), 0755), 0);
    for (const auto& file : fs::directory_iterator(inner)) {
      ASSERT_EQ(chmod(file.path().c_str(), 0644), 0);
    }
    const int status = in_child([&] { return setuid(nobody) != 0 ? 77 : user_reads(); });
    if (WEXITSTATUS(status) == 77) GTEST_SKIP() << "the user cannot be changed here";
    EXPECT_EQ(status, 0);
  } else {
    ASSERT_EQ(chmod(inner.c_str(), 0500), 0);
    EXPECT_EQ(user_reads(), 0);
    ASSERT_EQ(chmod(inner.c_str(), 0700), 0);
  }
  EXPECT_EQ(files_in(inner), 1U);
}

TEST(CacheFaults, ACacheOfAnotherUserIsRefused) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can make files of other users";
  const TemporaryFolder folder;
  const std::string inner = folder.file("cache");
  ASSERT_FALSE(ObjectCache::open(inner)->store(key(0), "", content(0)));
  auto cache = ObjectCache::open(inner);
  for (const auto& file : fs::directory_iterator(inner)) {
    ASSERT_EQ(chown(file.path().c_str(), nobody, nobody), 0);
  }
  const CacheHit hit = cache->load(key(0));
  EXPECT_FALSE(hit.content);
  EXPECT_NE(hit.rejected.find("belongs to user 65534"), std::string::npos) << hit.rejected;
  ASSERT_EQ(chown(inner.c_str(), nobody, nobody), 0);
  const auto refused = ObjectCache::open(inner);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.failure().message.find(inner), std::string::npos);
}

}  // namespace
}  // namespace navjit::cache
