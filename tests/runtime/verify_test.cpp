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

TEST(Verify, NoStateIsNoProof) {
  const Geometry geometry(std::make_shared<const World>(tests::mixed_world()));
  const DispatchTable table(geometry);
  const VolumeId top = geometry.world().top;
  const std::vector<Sample> samples = StateSampler(geometry).states(top, 32, 1);
  EXPECT_EQ(verify(geometry, table.context(), generic::dispatch_entry, top, samples), "");
  EXPECT_NE(verify(geometry, table.context(), generic::dispatch_entry, top, {}), "");
  EXPECT_NE(verify(geometry, table.context(), generic::dispatch_entry, top + 1, samples), "")
      << "states of another volume";
}

TEST(StateSampler, FindsStatesInWhatIsHardlyThere) {
  World world;
  tests::add_volume(world, "world", make_box("world", 3000, 3000, 3000));
  tests::add_volume(world, "shell", make_sphere("shell", 999.9999, 1000, 0, 7, 0, 4));
  tests::add_volume(world, "hoop", make_torus("hoop", 0, 0.05, 1200, 0, 7));
  tests::place(world, 0, 1, {0, 0, 0});
  tests::place(world, 0, 2, {0, 0, 1500});
  world.top = 0;
  finish(world);
  const Geometry geometry(std::make_shared<const World>(std::move(world)));
  const StateSampler sampler(geometry);
  for (const VolumeId volume : {1U, 2U}) {
    const std::vector<Sample> samples = sampler.states(volume, 100, 1);
    EXPECT_GT(samples.size(), 50U) << volume;
    for (const Sample& s : samples) EXPECT_EQ(s.volume, volume);
  }
}

}  // namespace
}  // namespace navjit
