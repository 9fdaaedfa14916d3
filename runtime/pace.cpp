#include "runtime/pace.hpp"

#include <algorithm>

namespace navjit {

double pause_after(Pace& pace, const Look& look) {
  pace.spent_s += look.took_s;
  pace.quiet = look.is_quiet ? std::min(2 * pace.quiet, Pace::longest_quiet) : 1;
  // Trials make no progress while nobody navigates, since no step is timed.
  pace.idle = look.is_idle ? std::min(2 * pace.idle, Pace::longest_idle) : 1;
  // The pause doubles while looks have cost more than they may, and halves while they have not. So
  // on average they cost what they may, unless the longest pause is still too short.
  const bool too_much = pace.spent_s > Pace::first_s + Pace::share * look.navigated_s;
  const double pays = look.is_quiet ? look.took_s / (Pace::share * look.poll_s) : 0;
  const double longest = std::clamp(pays, Pace::longest_thrifty, Pace::longest_idle);
  pace.thrifty = too_much ? std::min(2 * pace.thrifty, longest) : std::max(pace.thrifty / 2, 1.0);
  return std::max({pace.quiet, pace.thrifty, pace.idle});
}

}  // namespace navjit
