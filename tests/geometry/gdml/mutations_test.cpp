// Files that are nearly right, 20,000 and always the same ones: they are read and used, or refused.
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "tests/fuzz/mutate.hpp"
#include "tests/fuzz/seeds.hpp"
#include "tests/fuzz/use_detector.hpp"

namespace navjit::fuzz {
namespace {

class GdmlMutations : public ::testing::Test {
 protected:
  bool used(const std::string& text) const {
    std::ofstream(path_, std::ios::binary) << text;
    return use_detector(path_);
  }
  void TearDown() override { std::filesystem::remove(path_); }

  // Tests run side by side.
  std::filesystem::path path_ = std::filesystem::path(::testing::TempDir()) /
                                ("mutations_" + std::to_string(getpid()) + ".gdml");
};

TEST_F(GdmlMutations, SeedsAreRead) {
  for (const Seed& seed : seeds()) EXPECT_TRUE(used(seed.text)) << seed.name;
}

TEST_F(GdmlMutations, AreReadOrRefused) {
  const std::vector<Seed> all = seeds();
  Engine random(1);
  int good = 0;
  constexpr int count = 20'000;
  for (int i = 0; i < count; ++i) {
    std::string text = all[static_cast<std::size_t>(i) % all.size()].text;
    for (auto changes = 1 + random() % 4; changes > 0; --changes) mutate_once(text, random);
    good += used(text);
  }
  // Neither all nor none.
  EXPECT_GT(good, count / 20);
  EXPECT_LT(good, count * 19 / 20);
}

}  // namespace
}  // namespace navjit::fuzz
