#include "runtime/dispatch_table.hpp"

#include <gtest/gtest.h>

#include "geometry/navigation/generic.hpp"
#include "runtime/steady_seconds.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

TEST(DispatchTable, TellsSinceWhenAVolumeHasBeenSpecialised) {
  const Geometry geometry(std::make_shared<const World>(tests::mixed_world()));
  DispatchTable table(geometry);
  const kernels::DispatchEntry first = generic::dispatch_entry, second = first;
  EXPECT_EQ(table.specialised_since(1), 0);
  const double before = steady_seconds();
  table.install(1, &first, nullptr);
  const double since = table.specialised_since(1);
  EXPECT_GE(since, before);
  EXPECT_LE(since, steady_seconds());
  // Another navigator in its place, or the generic one for a trial's short stretch: still the same.
  table.install(1, &second, nullptr);
  table.show(1, &generic::dispatch_entry);
  EXPECT_EQ(table.specialised_since(1), since);
  EXPECT_EQ(table.specialised_since(0), 0);
  table.reset(1);
  EXPECT_EQ(table.specialised_since(1), 0);
  table.install(1, &second, nullptr);
  EXPECT_GE(table.specialised_since(1), since);
}

}  // namespace
}  // namespace navjit
