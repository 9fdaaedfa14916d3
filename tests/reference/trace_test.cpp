// The comparison of traces must see what is wrong: all that is built on it depends on this.
#include "tests/reference/trace.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <memory>
#include <random>
#include <sstream>
#include <stdexcept>

#include "tests/support/worlds.hpp"

namespace navjit::reference {
namespace {

const Trace three_rays = {
    {{"world", 10.5}, {"lead", 2}, {"tile", 4}, {"lead", 2}, {"world", 30}},
    {},
    {{"world", 1e4}, {"tile", 4}, {"tile", 4}, {"world", 7}},
};

TEST(TraceComparison, EqualTracesAgree) {
  const Comparison result = compare(three_rays, three_rays);
  EXPECT_EQ(result.rays, 3u);
  EXPECT_EQ(result.steps, 9u);
  EXPECT_EQ(result.differing, 0u);
  EXPECT_EQ(result.merged, 0u);
  EXPECT_EQ(result.stuck, 0u);
  EXPECT_EQ(result.agreement(), 1);
  EXPECT_TRUE(result.differences.empty());
}

TEST(TraceComparison, TellsAWrongVolume) {
  Trace wrong = three_rays;
  wrong[0][2].volume = "air";
  const Comparison result = compare(wrong, three_rays);
  ASSERT_EQ(result.differing, 1u);
  EXPECT_NEAR(result.agreement(), 2. / 3, 1e-15);
  const Difference& difference = result.differences.at(0);
  EXPECT_EQ(difference.ray, 0u);
  EXPECT_EQ(difference.step, 2u);
  EXPECT_EQ(difference.distance, 12.5);
  EXPECT_EQ(difference.ours, "4 mm in air");
  EXPECT_EQ(difference.theirs, "4 mm in tile");
  std::ostringstream words;
  words << result;
  EXPECT_NE(words.str().find("ray 0 step 2 at 12.5 mm: ours 4 mm in air, theirs 4 mm in tile"),
            std::string::npos)
      << words.str();
}

TEST(TraceComparison, TellsTwoVolumesInTheWrongOrder) {
  Trace wrong = three_rays;
  std::swap(wrong[0][1], wrong[0][2]);
  EXPECT_EQ(compare(wrong, three_rays).differing, 1u);
}

TEST(TraceComparison, TellsAShiftedLength) {
  for (const double shift : {2e-6, -2e-6, 1e-3}) {
    Trace wrong = three_rays;
    wrong[0][1].length += shift;
    EXPECT_EQ(compare(wrong, three_rays).differing, 1u) << shift;
    EXPECT_EQ(compare(three_rays, wrong).differing, 1u) << shift;
  }
  Trace rounded = three_rays;
  rounded[0][1].length += 0.9e-6;
  EXPECT_EQ(compare(rounded, three_rays).differing, 0u);
}

TEST(TraceComparison, ToleratesRoundingOfHugeLengths) {
  const Trace huge = {{{"world", 1e22}}};
  EXPECT_EQ(compare({{{"world", 1e22 * (1 + 5e-14)}}}, huge).differing, 0u);
  EXPECT_EQ(compare({{{"world", 1e22 * (1 + 5e-13)}}}, huge).differing, 1u);
  // The last bit of 1e22 is two million: a step of one bit more is a sliver.
  EXPECT_EQ(compare({{{"world", 1e22}, {"world", 2097152.}}}, huge).differing, 0u);
  EXPECT_EQ(compare({{{"world", 1e22}, {"lead", 1e10}}}, huge).differing, 1u);
}

TEST(TraceComparison, DropsSliversOnBothSides) {
  Trace slivers = three_rays;
  slivers[0].insert(slivers[0].begin() + 2, {"glue", 0.5e-6});
  slivers[0].insert(slivers[0].begin(), {"lead", 0});
  slivers[1].push_back({"world", 0.9e-6});
  EXPECT_EQ(compare(slivers, three_rays).differing, 0u);
  EXPECT_EQ(compare(three_rays, slivers).differing, 0u);
  EXPECT_EQ(compare(slivers, three_rays).merged, 0u);
  slivers[0][3].length = 1.5e-6;
  const Comparison result = compare(slivers, three_rays);
  ASSERT_EQ(result.differing, 1u);
  EXPECT_EQ(result.differences.at(0).step, 3u) << "slivers count in the step's number";
  EXPECT_EQ(result.differences.at(0).ours, "1.5e-06 mm in glue");
}

TEST(TraceComparison, MergesNeighboursOfOneName) {
  Trace merged = three_rays;
  merged[2] = {{"world", 1e4}, {"tile", 8}, {"world", 7}};
  const Comparison result = compare(merged, three_rays);
  EXPECT_EQ(result.differing, 0u);
  EXPECT_EQ(result.merged, 1u);
  merged[2][1].length = 8.1;
  EXPECT_EQ(compare(merged, three_rays).differing, 1u);
  EXPECT_EQ(compare(merged, three_rays).merged, 0u);
}

TEST(TraceComparison, PointsAtTheRealDifferenceNotAtTheMergedOne) {
  Trace wrong = three_rays;
  wrong[2] = {{"world", 1e4}, {"tile", 8}, {"world", 6}};
  const Comparison result = compare(wrong, three_rays);
  ASSERT_EQ(result.differing, 1u);
  EXPECT_EQ(result.differences.at(0).step, 2u);
  EXPECT_EQ(result.differences.at(0).theirs, "7 mm in world");
}

TEST(TraceComparison, TellsAMissingAndASurplusStep) {
  Trace shorter = three_rays;
  shorter[0].pop_back();
  EXPECT_EQ(compare(shorter, three_rays).differences.at(0).ours, "has left the world");
  EXPECT_EQ(compare(shorter, three_rays).differences.at(0).step, 4u);
  EXPECT_EQ(compare(three_rays, shorter).differences.at(0).theirs, "has left the world");
  shorter[2].clear();
  EXPECT_EQ(compare(shorter, three_rays).differing, 2u);
}

TEST(TraceComparison, AStuckRayNeverAgrees) {
  Trace stuck = three_rays;
  stuck[0].back() = {"world", 0, true};
  Comparison result = compare(stuck, three_rays);
  EXPECT_EQ(result.stuck, 1u);
  EXPECT_EQ(result.stuck_theirs, 0u);
  ASSERT_EQ(result.differing, 1u);
  EXPECT_EQ(result.differences.at(0).ours, "stuck in world");
  result = compare(three_rays, stuck);
  EXPECT_EQ(result.stuck, 0u);
  EXPECT_EQ(result.stuck_theirs, 1u);
  EXPECT_EQ(result.differing, 1u);
  result = compare(stuck, stuck);
  EXPECT_EQ(result.differing, 1u);
  EXPECT_EQ(result.stuck, 1u);

  // Nor one whose stuck row would vanish by merging.
  Trace at_end = three_rays;
  at_end[0].push_back({"world", 0, true});
  EXPECT_EQ(compare(at_end, three_rays).differing, 1u);
}

TEST(TraceComparison, KeepsOnlyTheFirstFewInWords) {
  const Trace ours(20, {{"lead", 1}}), theirs(20, {{"tile", 1}});
  const Comparison result = compare(ours, theirs, {}, 3);
  EXPECT_EQ(result.differing, 20u);
  EXPECT_EQ(result.agreement(), 0);
  ASSERT_EQ(result.differences.size(), 3u);
  EXPECT_EQ(result.differences[2].ray, 2u);
}

TEST(TraceComparison, RefusesTracesOfDifferentRays) {
  EXPECT_THROW(compare(three_rays, {{}, {}}), std::invalid_argument);
}

class TraceFile : public ::testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(path_); }

  const std::filesystem::path& write(const std::string& text, bool compressed = false) {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::path(::testing::TempDir()) / (std::string("navjit_") + test->name());
    const gzFile file = gzopen(path_.c_str(), compressed ? "wb" : "wbT");
    EXPECT_EQ(gzwrite(file, text.data(), static_cast<unsigned>(text.size())),
              static_cast<int>(text.size()));
    EXPECT_EQ(gzclose(file), Z_OK);
    return path_;
  }
  std::string error(const std::string& text, std::size_t rays = 3) {
    try {
      read_trace(write(text), rays);
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return "no error";
  }

  std::filesystem::path path_;
};

const std::string header = "ray,step,volume,length\n";
constexpr auto npos = std::string::npos;

TEST_F(TraceFile, IsReadPlainAndCompressed) {
  const std::string text = header +
                           "0,0,world0x7f,12.25\n0,1,lead,0\n"
                           "2,0,world0x7f,1.0000000000000002e-09\r\n2,1,lead,stuck\n";
  const Trace expected = {
      {{"world0x7f", 12.25}, {"lead", 0}},
      {},
      {{"world0x7f", 1.0000000000000002e-09}, {"lead", 0, true}},
  };
  EXPECT_EQ(read_trace(write(text), 3), expected);
  EXPECT_EQ(read_trace(write(text, true), 3), expected);
}

TEST_F(TraceFile, MustBeATrace) {
  EXPECT_THROW(read_trace("/nonexistent/trace.csv", 1), std::runtime_error);
  EXPECT_NE(error("").find("empty"), npos);
  EXPECT_NE(error("ray,volume\n").find(":1: not the header"), npos);
  EXPECT_NE(error(header + "0,0,world\n").find(":2: not a row"), npos);
  EXPECT_NE(error(header + "0,0,world,1,2\n").find(":2: not a row"), npos);
  EXPECT_NE(error(header + "0,0,world,1x\n").find(":2: not a row"), npos);
  EXPECT_NE(error(header + "0,0,world,nan\n").find(":2: not a row"), npos);
  EXPECT_NE(error(header + "0,0,world,-1\n").find(":2: not a row"), npos);
  EXPECT_NE(error(header + "3,0,world,1\n").find(":2: there are only 3 rays"), npos);
  EXPECT_NE(error(header + "0,1,world,1\n").find(":2: out of order"), npos);
  EXPECT_NE(error(header + "1,0,world,1\n0,0,world,1\n").find(":3: out of order"), npos);
  EXPECT_NE(error(header + "0,0,world,stuck\n0,1,world,1\n").find(":3: a stuck ray"), npos);
}

/// The test's own geometry: a wrong world has to be told from the right one.
TEST(TraceOfAWorld, TellsAMovedPlate) {
  const auto build = [](double shift) {
    World world = tests::mixed_world();
    world.volumes[world.top].daughters[0].transformation.translation[0] += shift;
    finish(world);
    return std::make_shared<const World>(std::move(world));
  };
  std::mt19937_64 random(1);
  std::vector<Ray> rays;
  for (int i = 0; i < 500; ++i) {
    const auto coordinate = [&] { return tests::uniform(random, -100, 100); };
    const double x = coordinate(), y = coordinate(), z = coordinate();
    rays.push_back({{x, y, z}, tests::random_direction(random)});
  }
  rays.push_back({{1e3, 0, 0}, {1, 0, 0}});
  const Trace right = make_trace(build(0), rays, JitMode::off);
  EXPECT_TRUE(right.back().empty()) << "a ray that starts outside has no steps";
  EXPECT_EQ(compare(right, right).differing, 0u);
  EXPECT_GT(compare(right, right).steps, 1000u);
  const Comparison wrong = compare(make_trace(build(1e-5), rays, JitMode::off), right);
  EXPECT_GT(wrong.differing, 5u);
  EXPECT_LT(wrong.differing, 250u);
  // The same to the last bit with every scene specialised.
  EXPECT_EQ(make_trace(build(0), rays, JitMode::wait), right);
}

}  // namespace
}  // namespace navjit::reference
