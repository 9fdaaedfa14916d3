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
  /// And while nobody navigates; the same where nothing is tried and looks are dear, as those at a
  /// hundred thousand volumes are.
  static constexpr double longest_idle = 200;

  double spent_s = 0;                       ///< processor time of looks
  double quiet = 1, thrifty = 1, idle = 1;  ///< pauses for each reason
};

/// A look that found nothing to do.
struct Look {
  double took_s = 0;       ///< processor time
  double navigated_s = 0;  ///< processor time of navigation so far
  bool is_quiet = false;   ///< nothing is tried
  bool is_idle = false;    ///< nothing was navigated since the last one
  double poll_s = 0.005;   ///< SpecialiserOptions::poll_ms
};

/// The pause after it, in units of poll_ms.
double pause_after(Pace& pace, const Look& look);

}  // namespace navjit
