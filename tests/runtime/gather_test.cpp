// States that navigators recorded are kept for verification, but no more than a run can carry.
#include "runtime/gather.hpp"

#include <gtest/gtest.h>

#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

TEST(Gather, KeepsFewStatesOfAVolumeWhereThereAreManyVolumes) {
  const auto world = std::make_shared<const World>(tests::mixed_world());
  const auto shared = std::make_shared<detail::Shared>(world, RuntimeOptions{});
  Specialisation spec(shared);
  const auto profile = std::make_shared<Profile>(world->volumes.size());
  shared->add(profile);
  const auto record = [&](VolumeId volume, int count) {
    Sample sample{};
    sample.volume = volume;
    for (int i = 0; i < count; ++i) profile->record(sample);
    gather(spec);
  };
  record(0, 600);
  EXPECT_EQ(spec.samples[0].size(), 512U);
  EXPECT_EQ(spec.samples_kept, 512U);
  EXPECT_EQ(spec.fresh[0].size(), 64U);
  EXPECT_EQ(spec.fresh_kept, 64U);
  spec.samples_kept = std::size_t{1} << 18;  // as if many other volumes had theirs
  record(1, 100);
  EXPECT_EQ(spec.samples[1].size(), few_recorded);
  record(0, 10);
  EXPECT_EQ(spec.samples[0].size(), 512U) << "newer ones replace older ones";
}

}  // namespace
}  // namespace navjit
