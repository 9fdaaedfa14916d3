// How often the specialiser looks at the profile. Private to runtime/.
#pragma once

namespace navjit {

/// What looks at the profile have cost, and the pause that follows from this.
struct Pace {
  /// Processor time that looks may take: this much at first, s, and in addition this share of the
  /// time of navigation. If all processors navigate, looks take their time from navigation.
  static constexpr double first_s = 0.3, share = 0.01;
  /// The longest pauses, in units of SpecialiserOptions::poll_ms: while nothing is on trial
  /// (quiet), and if looks have cost too much (thrifty). With either, a trial that lasts
  /// Trials::most_s has enough stretches.
  static constexpr double longest_quiet = 4, longest_thrifty = 16;
  /// The longest pause while nobody navigates. It is also the longest pause if nothing is on trial
  /// and a look is expensive, as with a hundred thousand volumes.
  static constexpr double longest_idle = 200;

  double spent_s = 0;                       ///< processor time of looks
  double quiet = 1, thrifty = 1, idle = 1;  ///< pauses for each reason
};

/// What the pause after a look depends on.
struct Look {
  double took_s = 0;       ///< processor time
  double navigated_s = 0;  ///< processor time of navigation so far
  bool is_quiet = false;   ///< nothing is on trial
  bool is_idle = false;    ///< nothing was navigated since the look before
  double poll_s = 0.005;   ///< SpecialiserOptions::poll_ms
};

/// The pause after a look, in units of poll_ms.
double pause_after(Pace& pace, const Look& look);

}  // namespace navjit
