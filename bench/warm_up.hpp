// Brings a runtime to the state of a long run before it is measured.
#pragma once

#include "common/clock.hpp"
#include "navjit/runtime.hpp"

namespace navjit::bench {

/// Repeats the work for at least so many seconds of processor time, until nothing is left to be
/// specialised and the newest navigators have been on trial. Trials that are still undecided are
/// then decided: a benchmark of milliseconds may fall into a stretch of a trial that uses the other
/// navigator, which a run does for a hundredth of its time.
template <class Work>
void warm_up(Runtime& runtime, double seconds, const Work& work) {
  for (const double part : {0.6, 0.4}) {
    const double until = common::thread_ns() + 1e9 * seconds * part;
    while (common::thread_ns() < until) work();
    runtime.wait_until_idle();
  }
  runtime.final_report(0);
}

}  // namespace navjit::bench
