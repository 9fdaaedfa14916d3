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
  bool skip_verification = false;  ///< what is wrong is installed, and stays
  bool skip_replay = false;        ///< what is slow on recorded states is installed
  bool pass_trials = false;        ///< and stays, whatever its own trial says
  bool lose_trials = false;        ///< or goes
  /// What navigators other than the generic one are taken to last, times their own.
  double specialised_lasts = 1;
  std::optional<Candidates> fastest{};  ///< the search that is taken to be so, where it is tried
};

}  // namespace navjit
