// Runs with a cache whose contents are right, damaged, foreign or hostile give the same answers.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <functional>

#include "cache/object_cache.hpp"
#include "jit/compiler.hpp"
#include "tests/support/command.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/traces.hpp"

namespace navjit {
namespace {

namespace fs = std::filesystem;
using tests::TemporaryFolder;

std::shared_ptr<const World> mixed() { return std::make_shared<const World>(tests::mixed_world()); }

RuntimeOptions with_cache(const std::string& directory, JitMode jit = JitMode::wait) {
  RuntimeOptions options = tests::eager_options(jit);
  options.cache = Cache::in(directory);
  return options;
}

/// Transports rays and compares every step with that of the generic navigator.
void expect_right(Runtime& runtime, const std::string& what = "") {
  Runtime generic(runtime.share_world(), tests::eager_options(JitMode::off));
  Navigator a = generic.navigator(), b = runtime.navigator();
  for (const Ray& ray : tests::rays_through(runtime.world(), 3, 300)) {
    const double tolerance = runtime.world().tolerance;
    ASSERT_TRUE(tests::same_bits(tests::trace(a, ray, tolerance), tests::trace(b, ray, tolerance)))
        << what;
  }
}

struct Counts {
  std::size_t specialised = 0, cached = 0, failed = 0;
};

Counts count(const Runtime& runtime) {
  Counts counts;
  for (const SceneReport& scene : runtime.report().scenes) {
    counts.specialised += scene.status == SceneStatus::specialised ? 1 : 0;
    counts.cached += scene.origin == CodeOrigin::cache ? 1 : 0;
    counts.failed += scene.status == SceneStatus::failed ? 1 : 0;
  }
  return counts;
}

/// One run, which fills the cache or finds it filled.
Counts run(const std::string& directory, const std::string& what = "") {
  Runtime runtime(mixed(), with_cache(directory));
  expect_right(runtime, what);
  const Counts counts = count(runtime);
  EXPECT_GE(counts.specialised, 3U) << what;
  EXPECT_EQ(counts.failed, 0U) << what;
  return counts;
}

std::vector<fs::path> files_in(const TemporaryFolder& folder) {
  std::vector<fs::path> files;
  for (const auto& file : fs::directory_iterator(folder.path())) files.push_back(file.path());
  std::sort(files.begin(), files.end());
  return files;
}

TEST(RuntimeCache, ASecondRunCompilesNothing) {
  const TemporaryFolder folder;
  const Counts first = run(folder.path());
  EXPECT_EQ(first.cached, 0U);
  Runtime second(mixed(), with_cache(folder.path()));
  expect_right(second);
  EXPECT_EQ(count(second).cached, first.specialised);
  EXPECT_EQ(second.report().cached_modules, second.report().modules);
  EXPECT_GT(second.report().code_bytes, 0U);
}

TEST(RuntimeCache, ANewRunInstallsWhatTheLastFoundHot) {
  const TemporaryFolder folder;
  const auto world = mixed();
  std::size_t hot = 0;
  {
    Runtime first(world, with_cache(folder.path(), JitMode::on));
    for (int pass = 0; pass < 3; ++pass) {
      expect_right(first);
      first.wait_until_idle();
    }
    expect_right(first);
    hot = count(first).specialised;
    EXPECT_GE(hot, 3U);
  }
  RuntimeOptions patient = with_cache(folder.path(), JitMode::on);
  patient.specialiser.min_steps = 1'000'000'000;  // nothing becomes hot by itself
  Runtime second(world, patient);
  second.wait_until_idle();
  expect_right(second);
  EXPECT_EQ(count(second).specialised, hot);
  EXPECT_EQ(count(second).cached, hot);
}

TEST(RuntimeCache, AModuleListThatIsHostileIsNotFollowed) {
  const TemporaryFolder folder;
  {
    Runtime first(mixed(), with_cache(folder.path(), JitMode::on));
    expect_right(first);
    first.wait_until_idle();
  }
  auto cache = cache::ObjectCache::open(folder.path());
  const auto entries = cache->list(true);
  const auto list = std::find_if(entries->begin(), entries->end(), [](const auto& e) {
    return e.label.find("hot in a detector") != std::string::npos;
  });
  ASSERT_NE(list, entries->end());
  cache::Digest key;
  for (std::size_t i = 0; i < key.size(); ++i) {
    key[i] = static_cast<unsigned char>(std::stoi(list->file.substr(2 * i, 2), nullptr, 16));
  }
  const std::string begin = "navjit hot scenes 3\n";
  for (const std::string& text :
       {std::string(), std::string("garbage"), begin + "4294967295\n", begin + "1 2 1\n",
        begin + "1\n1\n", begin + "-1\n", begin + "1", begin + "\n", begin + " 1\n",
        begin + "1:scan 2:scan 3:scan 4:scan 5:scan\n", begin + "1:all\n", begin + "1|2\n",
        begin + "1|2:scan 3:scan\n", begin + "1 2 3 4 5 6 7 8\n",
        begin + std::string(100000, '1') + "\n"}) {
    ASSERT_FALSE(cache->store(key, "hot in a detector", text));
    Runtime runtime(mixed(), with_cache(folder.path(), JitMode::on));
    expect_right(runtime, text.substr(0, 100));
    runtime.wait_until_idle();
    expect_right(runtime, text.substr(0, 100));
  }
}

TEST(RuntimeCache, OtherOptionsOfTheCompilerAreOtherEntries) {
  const TemporaryFolder folder;
  run(folder.path());
  RuntimeOptions options = with_cache(folder.path());
  options.specialiser.optimisation = 0;
  Runtime runtime(mixed(), options);
  expect_right(runtime);
  EXPECT_EQ(count(runtime).cached, 0U);
}

TEST(RuntimeCache, DamagedEntriesAreCompiledAgain) {
  const TemporaryFolder folder;
  run(folder.path());
  const std::vector<fs::path> files = files_in(folder);
  ASSERT_GE(files.size(), 1U);
  for (const fs::path& file : files) {
    const std::string right = tests::read_file(file);
    // Regions: header, key, checksum, label, ELF header, code, symbols; and the length.
    for (const double where : {0.0, 8.0, 30.0, 60.0, 90.0, 0.2, 0.5, 0.9, 1.0}) {
      std::string damaged = right;
      const auto at = where > 1
                          ? static_cast<std::size_t>(where)
                          : static_cast<std::size_t>(where * static_cast<double>(right.size() - 1));
      damaged[at] = static_cast<char>(damaged[at] ^ 16);
      tests::write_file(file, damaged);
      const Counts counts = run(folder.path(), "byte " + std::to_string(at));
      EXPECT_LT(counts.cached, counts.specialised) << "byte " << at;
      EXPECT_EQ(tests::read_file(file).size(), right.size()) << "stored again";
    }
    for (const std::size_t length : {std::size_t{0}, std::size_t{50}, right.size() / 2}) {
      tests::write_file(file, right.substr(0, length));
      EXPECT_LT(run(folder.path()).cached, 3U) << "length " << length;
    }
  }
  EXPECT_GE(run(folder.path()).cached, 3U) << "all is well again";
}

/// Puts other contents under the keys of a full cache, with correct checksums.
void poison(const TemporaryFolder& folder, const std::string& content) {
  auto cache = cache::ObjectCache::open(folder.path());
  for (const fs::path& file : files_in(folder)) {
    const std::string name = file.filename().string();
    cache::Digest key;
    for (std::size_t i = 0; i < key.size(); ++i) {
      key[i] = static_cast<unsigned char>(std::stoi(name.substr(2 * i, 2), nullptr, 16));
    }
    ASSERT_FALSE(cache->store(key, "poison", content));
  }
}

TEST(RuntimeCache, EntriesWithOtherContentAreCompiledAgain) {
  const TemporaryFolder folder;
  std::string source;
  {
    FaultyOptions options{with_cache(folder.path())};
    options.faults = tests::edited([&](std::string& text) { source = text; });
    FaultyRuntime runtime(mixed(), options);
    expect_right(runtime);
  }
  // The right functions, but every step is a little too long.
  const std::string right = "  return best;\n";
  std::string wrong = source;
  ASSERT_NE(wrong.find(right), std::string::npos);
  for (std::size_t at = 0; (at = wrong.find(right, at)) != std::string::npos; at += 20) {
    wrong.replace(at, right.size(), "  return best * (1 + 0x1p-52);\n");
  }
  const auto compiled = [](const std::string& text) {
    const auto object = jit::compile(text, "poison", {.optimisation = 1});
    if (!object) throw std::runtime_error(object.failure().message);
    return std::string(object->bytes.begin(), object->bytes.end());
  };
  const std::string library = tests::read_file("/proc/self/exe").substr(0, 1 << 20);
  for (const std::string& content :
       {compiled(wrong), compiled("extern \"C\" int other() { return 1; }"),
        compiled("extern \"C\" int getpid(); extern \"C\" int other() { return getpid(); }"),
        std::string(), std::string("garbage"), library}) {
    poison(folder, content);
    EXPECT_EQ(run(folder.path()).cached, 0U);
    EXPECT_GE(run(folder.path()).cached, 3U) << "and stored again";
  }
}

TEST(RuntimeCache, ADirectoryThatCannotBeUsedCostsNothingButSpeed) {
  const TemporaryFolder folder;
  tests::write_file(folder.file("file"), "no directory");
  fs::create_directory(folder.file("open"));
  ASSERT_EQ(chmod(folder.file("open").c_str(), 0777), 0);
  for (const std::string& directory :
       {folder.file("file"), folder.file("file/below"), folder.file("open"),
        folder.file("open/below"), std::string("/proc/nothing"), std::string(5000, 'x')}) {
    EXPECT_EQ(run(directory).cached, 0U);
  }
  EXPECT_TRUE(fs::is_empty(folder.file("open")));
}

TEST(RuntimeCache, WithoutBeingAskedNothingIsWritten) {
  const TemporaryFolder folder;
  setenv("XDG_CACHE_HOME", folder.path().c_str(), 1);
  Runtime runtime(mixed(), tests::eager_options(JitMode::wait));
  expect_right(runtime);
  EXPECT_EQ(Cache::user_default().directory, folder.file("navjit"));
  EXPECT_TRUE(fs::is_empty(folder.path()));
  setenv("XDG_CACHE_HOME", "relative", 1);
  setenv("HOME", folder.path().c_str(), 1);
  EXPECT_EQ(Cache::user_default().directory, folder.file(".cache/navjit"));
  unsetenv("XDG_CACHE_HOME");
  unsetenv("HOME");
  EXPECT_FALSE(Cache::user_default());
}

TEST(RuntimeCache, ManyRuntimesShareOne) {
  const TemporaryFolder folder;
  std::vector<pid_t> children;
  for (int n = 0; n < 8; ++n) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      Runtime runtime(mixed(), with_cache(folder.path(), JitMode::on));
      for (int pass = 0; pass < 3; ++pass) {
        expect_right(runtime);
        runtime.wait_until_idle();
      }
      _exit(testing::Test::HasFailure() || count(runtime).specialised < 3 ? 1 : 0);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
  }
  for (const fs::path& file : files_in(folder)) {
    EXPECT_EQ(file.extension(), ".navjit") << "nothing unfinished is left";
  }
}

TEST(RuntimeCache, TwoHundredProcessesTakeTheirCodeFromOne) {
  const TemporaryFolder folder;
  run(folder.path());
  const auto world = mixed();
  std::vector<pid_t> children;
  for (int n = 0; n < 200; ++n) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      Runtime runtime(world, with_cache(folder.path())),
          generic(world, RuntimeOptions{.jit = JitMode::off});
      Navigator a = generic.navigator(), b = runtime.navigator();
      bool same = true;
      for (const Ray& ray : tests::rays_through(*world, 7, 20)) {
        same &= tests::same_bits(tests::trace(a, ray, world->tolerance),
                                 tests::trace(b, ray, world->tolerance));
      }
      _exit(same && count(runtime).cached >= 3 ? 0 : 1);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
  }
}

}  // namespace
}  // namespace navjit
