// Means of times that were taken by a clock which does not stop when others have the processor.
#pragma once

#include <limits>
#include <vector>

#include "common/statistics.hpp"

namespace navjit::bench {

/// A time that is more than so many times the median was interrupted: who loses the processor loses
/// it for much longer than a few rays take. Rays that are merely slow have to count, as they do
/// where time is taken by a clock that stops.
constexpr double interrupted = 20;

/// The mean of the times that were not interrupted; 0 for none.
inline double mean_uninterrupted(const std::vector<double>& times) {
  const double median = common::quantile(times, 0.5);
  const double limit = median > 0 ? interrupted * median : std::numeric_limits<double>::infinity();
  double sum = 0, count = 0;
  for (const double time : times) {
    if (time > limit) continue;
    sum += time;
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

}  // namespace navjit::bench
