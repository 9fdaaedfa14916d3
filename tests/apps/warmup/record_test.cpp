// Runs of the warm-up experiment and their records.
#include <gtest/gtest.h>

#include <stdexcept>

#include "apps/warmup/experiment.hpp"

namespace navjit::warmup {
namespace {

RunSetup short_run() {
  RunSetup setup;
  setup.detector.file = std::string(NAVJIT_DETECTORS_DIR) + "/absorber.gdml";
  setup.seconds = 0.2;
  setup.interval = 0.01;
  setup.threads = 2;
  return setup;
}

RunRecord some_record() {
  RunRecord record;
  record.series = {{0, 0, 0}, {0.1, 5, 0.125}, {0.25, 90, 0.5}};
  record.swaps = {{0.2, 0.75}};
  record.rays = 3;
  record.steps = 90;
  record.other_s = 0.5;
  record.blocks = {{90, ~std::uint64_t{0}}};
  return record;
}

TEST(RunOnce, CountsWhatItDid) {
  const RunRecord record = run_once(short_run());
  ASSERT_GT(record.series.size(), 3U);
  for (std::size_t i = 1; i < record.series.size(); ++i) {
    EXPECT_GT(record.series[i].seconds, record.series[i - 1].seconds);
    EXPECT_GE(record.series[i].steps, record.series[i - 1].steps);
  }
  EXPECT_EQ(record.series.front().steps, 0);
  EXPECT_EQ(record.series.back().steps, static_cast<double>(record.steps));
  EXPECT_DOUBLE_EQ(record.series.back().processor_s, record.navigating_s);
  EXPECT_GE(record.series.back().seconds, 0.2);
  EXPECT_GT(record.rays, 0U);
  EXPECT_EQ(record.stuck, 0U);
  EXPECT_GT(record.navigating_s, 0);
  std::uint64_t kept = 0;
  for (const Block& block : record.blocks) kept += block.steps;
  EXPECT_GT(kept, 0U);
  EXPECT_LE(kept, record.steps);
  double share = 0;
  for (const Swap& swap : record.swaps) share += swap.share;
  EXPECT_LE(share, 1 + 1e-9);
}

TEST(RunOnce, KeepsAlmostAllRaysForTheComparison) {
  RunSetup setup = short_run();
  setup.threads = 1;
  const RunRecord record = run_once(setup);
  std::uint64_t rays = 0;
  for (std::size_t i = 0; i < record.blocks.size(); ++i) rays += chunks_in(i) * rays_per_chunk;
  EXPECT_LE(rays, record.rays);
  EXPECT_GE(rays + rays / 32 + rays_per_chunk, record.rays);
}

TEST(Record, DiffersFromOneWithAnotherLateBlock) {
  RunRecord a, b;
  a.blocks.assign(500, {7, 7});
  b.blocks.assign(400, {7, 7});
  EXPECT_TRUE(same_rays(a, b)) << "as far as both went";
  b.blocks[399].lengths = 8;
  EXPECT_FALSE(same_rays(a, b));
}

TEST(RunOnce, RaysAreTheSameWhateverTheJitDoes) {
  RunSetup setup = short_run();
  const RunRecord on = run_once(setup);
  setup.runtime.jit = JitMode::off;
  setup.threads = 1;
  const RunRecord off = run_once(setup);
  EXPECT_TRUE(off.swaps.empty());
  EXPECT_EQ(off.modules, 0U);
  EXPECT_TRUE(same_rays(on, off));
  setup.source.seed = 2;
  EXPECT_FALSE(same_rays(on, run_once(setup)));
}

TEST(Record, SurvivesBeingText) {
  const RunRecord record = some_record(), again = from_text(to_text(record));
  ASSERT_EQ(again.series.size(), 3U);
  EXPECT_EQ(again.series[2].seconds, 0.25);
  EXPECT_EQ(again.series[2].steps, 90);
  ASSERT_EQ(again.swaps.size(), 1U);
  EXPECT_EQ(again.swaps[0].share, 0.75);
  EXPECT_EQ(again.steps, 90U);
  EXPECT_EQ(again.other_s, 0.5);
  EXPECT_TRUE(again.blocks == record.blocks);
}

TEST(Record, RefusesWhatIsNone) {
  std::string text = to_text(some_record());
  for (const char* bad : {"", "{", "[]", "{}", "null", "{\"rays\":\"many\"}"}) {
    EXPECT_THROW(from_text(bad), Error) << bad;
  }
  const auto with = [&](const std::string& old, const std::string& by) {
    std::string changed = text;
    changed.replace(changed.find(old), old.size(), by);
    return changed;
  };
  EXPECT_THROW(from_text(with("[0.25,90.0,0.5]", "[0.05,90.0,0.5]")), Error);
  EXPECT_THROW(from_text(with("[0.25,90.0,0.5]", "[0.25,1.0,0.5]")), Error);
  EXPECT_THROW(from_text(with("[0.25,90.0,0.5]", "[0.25,90.0,0.1]")), Error);
  EXPECT_THROW(from_text(with("[0.25,90.0,0.5]", "[0.25]")), Error);
  EXPECT_THROW(from_text(with("[0.25,90.0,0.5]", "[-0.25,90.0,0.5]")), Error);
  for (std::size_t n = 0; n < text.size(); n += 7) {
    EXPECT_THROW(from_text(text.substr(0, n)), Error) << n;
  }
}

TEST(Figures, ComeFromTheRecords) {
  RunRecord off, on;
  off.series = {{0, 0, 0}, {4, 400, 4}};
  // Half as fast, then twice; but it had the processor to itself half of the time.
  on.series = {{0, 0, 0}, {1, 50, 0.5}, {4, 650, 2}};
  on.swaps = {{1, 0.6}, {2, 0.35}};
  const RunFigures figures = figures_of(on, off);
  ASSERT_TRUE(figures.break_even_s);
  EXPECT_DOUBLE_EQ(*figures.break_even_s, 1.5);
  EXPECT_EQ(figures.half_s, 1.0);
  EXPECT_EQ(figures.most_s, 2.0);
  EXPECT_DOUBLE_EQ(figures.share, 0.95);
  ASSERT_TRUE(figures.speed_up);
  EXPECT_DOUBLE_EQ(*figures.speed_up, 4) << "in processor time";
  EXPECT_DOUBLE_EQ(figures.steps_per_second, 162.5);
}

TEST(Figures, OfARunThatMadeNoStepHaveNoSpeedUp) {
  RunRecord off, late;
  off.series = {{0, 0, 0}, {0.1, 400, 0.1}};
  late.series = {{0, 0, 0}, {0.2, 0, 0}, {0.20001, 0, 0.00001}};  // its plugin took all the time
  EXPECT_FALSE(figures_of(late, off).speed_up);
  EXPECT_FALSE(figures_of(off, late).speed_up);
}

}  // namespace
}  // namespace navjit::warmup
