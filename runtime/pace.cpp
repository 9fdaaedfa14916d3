#include "runtime/pace.hpp"

#include <algorithm>

namespace navjit {

double pause_after(Pace& pace, double look_s, double navigated_s, bool is_quiet) {
  pace.spent_s += look_s;
  pace.quiet = is_quiet ? std::min(2 * pace.quiet, Pace::longest_quiet) : 1;
  // Twice as long while looks have cost more than they may, and half as long while they have not:
  // in the mean they cost that, but for what the longest pause leaves.
  const bool too_much = pace.spent_s > Pace::first_s + Pace::share * navigated_s;
  pace.thrifty = too_much ? std::min(2 * pace.thrifty, Pace::longest_thrifty)
                          : std::max(pace.thrifty / 2, 1.0);
  return std::max(pace.quiet, pace.thrifty);
}

}  // namespace navjit
