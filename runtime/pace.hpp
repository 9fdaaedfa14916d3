// How often the specialiser looks at the profile. Private to runtime/.
#pragma once

namespace navjit {

/// What looks have cost, and the pause that follows from it.
struct Pace {
  /// Looks may take so much processor time at first, s, and this share of navigation's beside:
  /// where all processors navigate, it is taken from them.
  static constexpr double first_s = 0.3, share = 0.01;
  /// The longest pauses, in units of SpecialiserOptions::poll_ms: while nothing is tried, and where
  /// looks have cost too much. A trial of Trials::most_s has enough stretches with either.
  static constexpr double longest_quiet = 4, longest_thrifty = 16;

  double spent_s = 0;             ///< processor time of looks
  double quiet = 1, thrifty = 1;  ///< pauses for either reason
};

/// The pause after a look that found nothing to do and took `look_s`, in units of poll_ms.
/// `navigated_s`: processor time of navigation so far. `is_quiet`: nothing is tried.
double pause_after(Pace& pace, double look_s, double navigated_s, bool is_quiet);

}  // namespace navjit
