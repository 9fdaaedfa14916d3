// What a Runtime, its navigators and its specialiser share. Private to runtime/.
#pragma once

#include <mutex>
#include <vector>

#include "navjit/navigator.hpp"
#include "navjit/options.hpp"
#include "runtime/dispatch_table.hpp"
#include "runtime/faults.hpp"
#include "runtime/log.hpp"

namespace navjit::detail {

/// What all navigators counted, by volume.
struct Counts {
  std::vector<std::shared_ptr<Profile>> profiles;
  std::vector<std::uint64_t> past_steps, past_bail_outs;  ///< of profiles that no longer exist
  std::uint64_t past_locations = 0;

  std::uint64_t steps(VolumeId volume) const;
  std::uint64_t bail_outs(VolumeId volume) const;
  /// In all volumes.
  std::uint64_t locations() const;
};

struct Shared {
  Shared(std::shared_ptr<const World> world, RuntimeOptions runtime_options, Faults to_try = {});

  /// A new navigator's profile.
  void add(std::shared_ptr<Profile> profile);
  Counts counts() const;
  /// The mutex that guards the counts, which must be locked during a fork().
  std::mutex& mutex() const { return mutex_; }

  RuntimeOptions options;
  Faults faults;
  std::shared_ptr<spdlog::logger> log;
  Geometry geometry;
  DispatchTable table;

 private:
  mutable std::mutex mutex_;  ///< guards the members below
  Counts counts_;
};

}  // namespace navjit::detail
