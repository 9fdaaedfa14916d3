// What a Runtime, its navigators and its specialiser share. Private to runtime/.
#pragma once

#include <mutex>
#include <vector>

#include "runtime/navigator.hpp"
#include "runtime/options.hpp"

namespace navjit::detail {

/// What all navigators counted, by volume.
struct Counts {
  std::vector<std::shared_ptr<Profile>> profiles;
  std::vector<std::uint64_t> past_steps, past_declined;  ///< of profiles that are no more

  std::uint64_t steps(VolumeId volume) const;
  std::uint64_t declined(VolumeId volume) const;
};

struct Shared {
  Shared(std::shared_ptr<const World> world, RuntimeOptions runtime_options);

  /// A new navigator's profile.
  void add(std::shared_ptr<Profile> profile);
  Counts counts() const;

  RuntimeOptions options;
  Geometry geometry;
  NavigatorTable table;

 private:
  mutable std::mutex mutex_;  ///< guards what follows
  Counts counts_;
};

}  // namespace navjit::detail
