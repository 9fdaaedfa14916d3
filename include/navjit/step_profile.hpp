// How often the volumes of a detector were used, kept in a file between runs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "navjit/detail/api.hpp"
#include "navjit/errors.hpp"
#include "navjit/state.hpp"

namespace NAVJIT_API navjit {

/// What Runtime::step_profile() gives.
struct StepProfile {
  /// One logical volume.
  struct Volume {
    VolumeId volume = 0;
    std::string name;
    std::uint64_t steps = 0;
    std::uint64_t relocations = 0;  ///< about how many steps ended with a relocation in it
  };
  std::string geometry;  ///< fingerprint of the detector that it is of
  std::uint64_t runs = 0;
  std::vector<Volume> volumes;  ///< those that were used, by number
};

/// JSON (docs/cache.md). Thread-safe, as all functions below.
std::string profile_text(const StepProfile& profile);

/// Writes the profile to a file; an older file is replaced only once all of it is written. Throws
/// Error, which names the file, if it cannot be written.
void write_profile(const StepProfile& profile, const std::string& path);

/// Throws Error, which names the file, for what is no profile: every value is checked. The file may
/// be hostile: at most 64 MB are read.
StepProfile read_profile(const std::string& path);

/// The same for what profile_text() gave; errors name it `name`.
StepProfile parse_profile(const std::string& text, const std::string& name = "the profile");

/// The sums of both. Throws Error if they are of different detectors.
StepProfile merge(const StepProfile& a, const StepProfile& b);

}  // namespace navjit
