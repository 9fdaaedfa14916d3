// What is measured as in a long run.
#pragma once

#include "common/clock.hpp"
#include "navjit/runtime.hpp"

namespace navjit::bench {

/// Does the work again and again, for so many seconds of processor time and more, until nothing is
/// left to be specialised and what came last has been on trial. What is still undecided then is
/// decided: a benchmark of milliseconds may fall into a stretch of a trial that shows the other
/// side, which a run has for a hundredth of its time.
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
