// How often the specialiser looks at the profile. Private to runtime/.
#pragma once

namespace navjit {

/// What looks have cost, and the pause that follows from it.
struct Pace {
  /// Processor time that looks may take: this much at first, s, and this share of navigation's time
  /// beside. Where all processors navigate, looks take it from navigation.
  static constexpr double first_s = 0.3, share = 0.01;
  /// The longest pauses, in units of SpecialiserOptions::poll_ms: while nothing is on trial
  /// (quiet), and where looks have cost too much (thrifty). With either, a trial that lasts
  /// Trials::most_s has enough stretches.
  static constexpr double longest_quiet = 4, longest_thrifty = 16;
  /// The longest pause while nobody navigates. It also bounds the pause where nothing is on trial
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
  bool is_idle = false;    ///< nothing was navigated since the last one
  double poll_s = 0.005;   ///< SpecialiserOptions::poll_ms
};

/// The pause after it, in units of poll_ms.
double pause_after(Pace& pace, const Look& look);

}  // namespace navjit
