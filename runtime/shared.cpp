#include "runtime/shared.hpp"

#include "runtime/check_options.hpp"

namespace navjit::detail {
namespace {

/// Profiles of destroyed navigators are kept for the states that were recorded in them, but no more
/// than this many, because a run may make any number of navigators.
constexpr std::size_t most_profiles = 64;

}  // namespace

std::uint64_t Counts::steps(VolumeId volume) const {
  std::uint64_t sum = past_steps[volume];
  for (const auto& profile : profiles) sum += profile->steps(volume);
  return sum;
}

std::uint64_t Counts::bail_outs(VolumeId volume) const {
  std::uint64_t sum = past_bail_outs[volume];
  for (const auto& profile : profiles) sum += profile->bail_outs(volume);
  return sum;
}

std::uint64_t Counts::locations() const {
  std::uint64_t sum = past_locations;
  for (const auto& profile : profiles) sum += profile->locations();
  return sum;
}

Shared::Shared(std::shared_ptr<const World> world, RuntimeOptions runtime_options, Faults to_try)
    : options(checked(std::move(runtime_options))),
      faults(std::move(to_try)),
      log(make_log(options.log)),
      geometry(std::move(world), options.geometry),
      table(geometry) {
  counts_.past_steps.resize(geometry.size());
  counts_.past_bail_outs.resize(geometry.size());
}

void Shared::add(std::shared_ptr<Profile> profile) {
  const std::lock_guard lock(mutex_);
  if (counts_.profiles.size() >= most_profiles) {
    std::erase_if(counts_.profiles, [this](const std::shared_ptr<Profile>& old) {
      if (!old->finished()) return false;
      for (VolumeId v = 0; v < geometry.size(); ++v) {
        counts_.past_steps[v] += old->steps(v);
        counts_.past_bail_outs[v] += old->bail_outs(v);
      }
      counts_.past_locations += old->locations();
      return true;
    });
  }
  counts_.profiles.push_back(std::move(profile));
}

Counts Shared::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

}  // namespace navjit::detail
