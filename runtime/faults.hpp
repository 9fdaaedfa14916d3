// Faults that can be provoked on purpose. Only for tests.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "analysis/scene_plan.hpp"

namespace navjit {

/// What is said of right code where a test wants it to be wrong (Faults::fail_verification).
constexpr const char* injected_failure = "injected failure";

/// Ways to make specialisation go wrong.
struct Faults {
  std::function<void(std::string& source)> edit_source{};
  bool fail_verification = false;
  /// Called on the compiling thread before each compilation, as if it were part of the compilation.
  /// It may take long, and may throw.
  std::function<void()> compiling{};
  bool skip_verification = false;  ///< code that fails verification is installed, and stays
  bool skip_replay = false;        ///< code that is slow on recorded states is installed
  bool pass_trials = false;        ///< single scenes on trial always keep their candidate
  bool lose_trials = false;        ///< single scenes on trial always lose their candidate
  /// Factor on the measured times of all navigators other than the generic one.
  double specialised_lasts = 1;
  std::optional<Candidates>
      fastest{};  ///< the search that counts as the fastest in scenes where it is tried
};

}  // namespace navjit
