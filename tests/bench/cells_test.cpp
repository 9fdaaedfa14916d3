// Cells of tables, and means over what was measured.
#include "bench/cells.hpp"

#include <gtest/gtest.h>

namespace navjit::bench {
namespace {

TEST(Cells, ShowFigures) {
  EXPECT_EQ(cell(12.345, 1), "12.3");
  EXPECT_EQ(cell(common::Summary{2, 1.5, 2.25}, 2), "2.00 (1.50..2.25)");
  EXPECT_EQ(cell(each(10, 4), 1), "2.5");
}

TEST(Cells, ShowADashWhereNothingWasMeasured) {
  EXPECT_EQ(cell(each(10, 0), 1), "-");
  EXPECT_EQ(cell(1.0 / 0.0, 1), "-");
  EXPECT_EQ(cell(common::Summary{unmeasured, unmeasured, unmeasured}, 1), "-");
}

TEST(Cells, MeansLeaveOutWhatWasNotMeasured) {
  EXPECT_DOUBLE_EQ(mean_of({2, unmeasured, 8}), 4);
  EXPECT_EQ(worst_of({unmeasured, 2, 8}), 2);
  EXPECT_EQ(cell(mean_of({unmeasured}), 2), "-");
  EXPECT_EQ(cell(worst_of({}), 2), "-");
}

}  // namespace
}  // namespace navjit::bench
