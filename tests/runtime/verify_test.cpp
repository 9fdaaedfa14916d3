#include "runtime/verify.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "geometry/navigation/generic.hpp"
#include "runtime/dispatch_table.hpp"
#include "runtime/states.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

constexpr double asleep_ns = 300'000;

double slow_step(NavigationStack* stack, const kernels::Context* context, const void* data,
                 double x, double y, double z, double limit) {
  std::this_thread::sleep_for(std::chrono::nanoseconds(static_cast<long>(asleep_ns)));
  return generic::dispatch_entry.step(stack, context, data, x, y, z, limit);
}

TEST(TimePerStep, IsProcessorTime) {
  const Geometry geometry(std::make_shared<const World>(tests::mixed_world()));
  const DispatchTable table(geometry);
  const std::vector<Sample> samples = StateSampler(geometry).states(geometry.world().top, 32, 1);
  ASSERT_GT(samples.size(), 8U);
  kernels::DispatchEntry slow = generic::dispatch_entry;
  slow.step = slow_step;
  const double ns = time_per_step(geometry, table.context(), slow, samples);
  EXPECT_GT(ns, 0);
  EXPECT_LT(ns, asleep_ns / 3) << "waiting costs no processor time";
}

}  // namespace
}  // namespace navjit
