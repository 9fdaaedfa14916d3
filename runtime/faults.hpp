// Faults to be tried on purpose. For tests alone.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "analysis/scene_plan.hpp"

namespace navjit {

/// Ways to make specialisation go wrong.
struct Faults {
  std::function<void(std::string& source)> edit_source{};
  bool fail_verification = false;
  /// Called on the compiling thread before each compilation, as if it were part of it: it may take
  /// its time, and throw.
  std::function<void()> compiling{};
  bool skip_verification = false;  ///< code that fails verification is installed, and stays
  bool skip_replay = false;        ///< code that is slow on recorded states is installed
  bool pass_trials = false;        ///< what is on trial by itself stays, whatever the trial says
  bool lose_trials = false;        ///< what is on trial by itself goes, whatever the trial says
  /// Factor on the measured times of all navigators other than the generic one.
  double specialised_lasts = 1;
  std::optional<Candidates>
      fastest{};  ///< the search that counts as the fastest, where it is tried
};

}  // namespace navjit
