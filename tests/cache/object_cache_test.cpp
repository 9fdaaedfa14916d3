// The cache gives back what was stored, or nothing, and it stays within its size.
#include "cache/object_cache.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <ctime>
#include <random>
#include <thread>

#include "tests/support/command.hpp"
#include "tests/support/folder.hpp"

namespace navjit::cache {
namespace {

namespace fs = std::filesystem;
using navjit::tests::files_in;
using navjit::tests::TemporaryFolder;

Digest key(int number) { return sha256({std::to_string(number)}); }

std::string file_of(const Digest& k) { return hex(k) + ".navjit"; }

std::string content(int number, std::size_t bytes) {
  std::mt19937_64 random(static_cast<unsigned>(number));
  std::string text;
  while (text.size() < bytes) text += static_cast<char>(random());
  return text;
}

std::string text(const std::vector<char>& bytes) { return {bytes.begin(), bytes.end()}; }

ObjectCache open(const TemporaryFolder& folder, const CacheLimits& limits = {}) {
  auto cache = ObjectCache::open(folder.path(), limits);
  if (!cache) throw std::runtime_error(cache.failure().message);
  return *std::move(cache);
}

/// Makes an entry look as if it had last been used so long ago.
void age(const TemporaryFolder& folder, const Digest& k, std::int64_t seconds) {
  timespec times[2];
  clock_gettime(CLOCK_REALTIME, &times[0]);
  times[0].tv_sec -= seconds;
  times[1] = times[0];
  ASSERT_EQ(utimensat(AT_FDCWD, folder.file(file_of(k)).c_str(), times, 0), 0);
}

TEST(Sha256, IsTheStandardsFunction) {
  // FIPS 180-4, examples of NIST.
  EXPECT_EQ(hex(sha256({"abc"})),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(hex(sha256({"abcdbcdecdefdefgefghfghighijhijki", "jkljklmklmnlmnomnopnopq"})),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_NE(sha256_of_parts({"ab", "c"}), sha256_of_parts({"a", "bc"}));
}

TEST(ObjectCacheTest, GivesBackWhatWasStoredAlsoToOtherProcesses) {
  const TemporaryFolder folder;
  ObjectCache cache = open(folder);
  for (const std::size_t size : {0UL, 1UL, 4096UL, 1000003UL}) {
    const int n = static_cast<int>(size);
    EXPECT_FALSE(cache.load(key(n)).content);
    EXPECT_EQ(cache.load(key(n)).rejected, "") << "what is not there is no reason to complain";
    ASSERT_FALSE(cache.store(key(n), "label", content(n, size)));
    const CacheHit hit = open(folder).load(key(n));
    ASSERT_TRUE(hit.content) << hit.rejected;
    EXPECT_TRUE(text(*hit.content) == content(n, size));
  }
  ASSERT_FALSE(cache.store(key(1), "label", "replaced"));
  EXPECT_EQ(text(*cache.load(key(1)).content), "replaced");
  cache.discard(key(1));
  EXPECT_FALSE(cache.load(key(1)).content);
  EXPECT_TRUE(cache.load(key(4096)).content);
}

TEST(ObjectCacheTest, ListsVerifiesAndClearsOnlyItsOwnFiles) {
  const TemporaryFolder folder;
  ObjectCache cache = open(folder);
  for (int i = 0; i < 3; ++i) {
    ASSERT_FALSE(cache.store(key(i), "scene " + std::to_string(i) + "\n\x1b[31m", content(i, 100)));
    age(folder, key(i), 1000 * (i + 1));
  }
  navjit::tests::write_file(folder.file("notes.txt"), "mine");
  auto entries = cache.list(true);
  ASSERT_TRUE(entries);
  ASSERT_EQ(entries->size(), 3U);
  for (int i = 0; i < 3; ++i) {
    const CacheEntry& entry = (*entries)[static_cast<std::size_t>(i)];
    EXPECT_EQ(entry.file, file_of(key(i))) << "most recently used first";
    EXPECT_EQ(entry.label, "scene " + std::to_string(i) + "??[31m") << "safe to print";
    EXPECT_EQ(entry.payload, 100U);
    EXPECT_EQ(entry.problem, "");
  }
  // Damage in the content is for verify to find.
  std::string damaged = navjit::tests::read_file(folder.file(file_of(key(1))));
  damaged.back() = static_cast<char>(damaged.back() ^ 1);
  navjit::tests::write_file(folder.file(file_of(key(1))), damaged);
  const auto problems = [&](bool verify) {
    const auto listed = cache.list(verify);
    return std::count_if(listed->begin(), listed->end(),
                         [](const CacheEntry& e) { return !e.problem.empty(); });
  };
  EXPECT_EQ(problems(false), 0);
  EXPECT_EQ(problems(true), 1);
  const auto removed = cache.clear();
  ASSERT_TRUE(removed);
  EXPECT_EQ(*removed, 3U);
  EXPECT_EQ(files_in(folder.path()), 1U);
  EXPECT_EQ(navjit::tests::read_file(folder.file("notes.txt")), "mine");
}

TEST(ObjectCacheTest, EntriesCanBeReadByWhoCanReadTheirDirectory) {
  const TemporaryFolder folder;
  for (const auto& [directory, entry] : {std::pair(0700, 0600), {0755, 0644}, {0750, 0640}}) {
    ASSERT_EQ(chmod(folder.path().c_str(), static_cast<mode_t>(directory)), 0);
    ASSERT_FALSE(open(folder).store(key(1), "", "content"));
    struct stat status;
    ASSERT_EQ(stat(folder.file(file_of(key(1))).c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, static_cast<mode_t>(entry));
  }
}

TEST(ObjectCacheTest, AUseMendsATimeInTheFuture) {
  const TemporaryFolder folder;
  ObjectCache cache = open(folder);
  ASSERT_FALSE(cache.store(key(1), "", "content"));
  age(folder, key(1), -1'000'000);
  EXPECT_TRUE(cache.load(key(1)).content);
  EXPECT_LE(cache.list(false)->at(0).last_used, std::time(nullptr) + 60);
}

TEST(ObjectCacheTest, EvictsWhatWasUsedLeastRecently) {
  const TemporaryFolder folder;
  // Four entries of 100 kB each fit.
  ObjectCache cache = open(folder, {.max_bytes = 430000});
  for (int i = 0; i < 4; ++i) {
    ASSERT_FALSE(cache.store(key(i), "", content(i, 100000)));
    age(folder, key(i), 10000 - 1000 * i);
  }
  EXPECT_TRUE(cache.load(key(0)).content);  // the oldest is used again
  ASSERT_FALSE(cache.store(key(4), "", content(4, 100000)));
  EXPECT_TRUE(cache.load(key(0)).content);
  EXPECT_FALSE(cache.load(key(1)).content);
  EXPECT_TRUE(cache.load(key(2)).content);
  EXPECT_TRUE(cache.load(key(4)).content);
}

TEST(ObjectCacheTest, StaysWithinItsSizeWhateverIsStored) {
  const TemporaryFolder folder;
  constexpr std::uint64_t limit = 200000;
  ObjectCache cache = open(folder, {.max_bytes = limit});
  std::mt19937_64 random(1);
  for (int i = 0; i < 300; ++i) {
    const std::size_t size = random() % 30000;
    ASSERT_FALSE(cache.store(key(i), "", content(i, size)));
    EXPECT_TRUE(i % 50 != 0 || cache.load(key(i)).content) << "the newest is there";
    std::uint64_t total = 0;
    for (const auto& file : fs::directory_iterator(folder.path())) total += file.file_size();
    ASSERT_LE(total, limit);
  }
  EXPECT_TRUE(cache.store(key(1000), "", content(1, limit + 1))) << "larger than the whole cache";
}

TEST(ObjectCacheTest, AnEntryIsGoodForItsKeyOnly) {
  const TemporaryFolder folder;
  ObjectCache cache = open(folder);
  ASSERT_FALSE(cache.store(key(1), "", "one"));
  fs::copy_file(folder.file(file_of(key(1))), folder.file(file_of(key(2))));
  const CacheHit hit = cache.load(key(2));
  EXPECT_FALSE(hit.content);
  EXPECT_NE(hit.rejected.find("another key"), std::string::npos) << hit.rejected;
}

TEST(ObjectCacheTest, EveryFlippedBitAndEveryTruncationIsRejectedAndStoredAgain) {
  const TemporaryFolder folder;
  ObjectCache cache = open(folder);
  const std::string right = content(1, 300);
  ASSERT_FALSE(cache.store(key(1), "a label", right));
  const std::string path = folder.file(file_of(key(1)));
  const std::string file = navjit::tests::read_file(path);
  const auto expect_rejected = [&](const std::string& damaged, const std::string& what) {
    navjit::tests::write_file(path, damaged);
    const CacheHit hit = cache.load(key(1));
    EXPECT_FALSE(hit.content) << what;
    EXPECT_NE(hit.rejected, "") << what;
  };
  for (std::size_t bit = 0; bit < 8 * file.size(); ++bit) {
    std::string damaged = file;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << bit % 8));
    expect_rejected(damaged, "bit " + std::to_string(bit));
  }
  for (std::size_t length = 0; length < file.size(); ++length) {
    expect_rejected(file.substr(0, length), "length " + std::to_string(length));
  }
  expect_rejected(file + '\0', "one byte more");
  expect_rejected(file + file, "twice");
  ASSERT_FALSE(cache.store(key(1), "a label", right));
  EXPECT_EQ(text(*cache.load(key(1)).content), right);
}

TEST(ObjectCacheTest, WhatIsNoFileOfTheUsersIsRejected) {
  const TemporaryFolder folder;
  ObjectCache cache = open(folder);
  ASSERT_FALSE(cache.store(key(1), "", "content"));
  const std::string path = folder.file(file_of(key(1)));
  const auto rejected = [&] {
    const CacheHit hit = cache.load(key(1));
    return hit.content ? std::string() : hit.rejected;
  };
  EXPECT_EQ(rejected(), "");
  for (const mode_t mode : {0620, 0602, 0666}) {
    ASSERT_EQ(chmod(path.c_str(), mode), 0);
    EXPECT_NE(rejected().find("written by others"), std::string::npos) << rejected();
  }
  ASSERT_EQ(chmod(path.c_str(), 0600), 0);
  EXPECT_TRUE(cache.load(key(1)).content);
  fs::rename(path, folder.file("elsewhere"));
  fs::create_symlink(folder.file("elsewhere"), path);
  EXPECT_NE(rejected(), "");
  fs::remove(path);
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  EXPECT_NE(rejected(), "") << "and it did not wait for a writer";
  fs::remove(path);
  fs::create_directory(path);
  EXPECT_NE(rejected(), "");
  EXPECT_TRUE(cache.store(key(1), "", "content")) << "a directory is in the way";
  EXPECT_EQ(files_in(folder.path()), 2U) << "nothing is left of the attempt";
  EXPECT_TRUE(cache.list(true));
}

TEST(ObjectCacheTest, ThreadsWithCachesOfOneDirectoryDoNotDisturbEachOther) {
  const TemporaryFolder folder;
  std::vector<std::thread> threads;
  std::atomic<int> wrong{0}, hits{0};
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      ObjectCache cache = open(folder, {.max_bytes = 60000});
      for (int i = 0; i < 150; ++i) {
        const int n = (i * 7 + t) % 10;
        const CacheHit hit = cache.load(key(n));
        if (hit.content) {
          ++hits;
          wrong += text(*hit.content) != content(n, 7000);
        } else {
          cache.store(key(n), "", content(n, 7000));
        }
        wrong += hit.rejected.empty() ? 0 : 1;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(hits, 0);
}

}  // namespace
}  // namespace navjit::cache
