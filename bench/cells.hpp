// Cells of the tables that benchmarks print. Where there was nothing to measure, a figure is not a
// number: a cell shows a dash for it, and JSON has null.
#pragma once

#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "common/statistics.hpp"

namespace navjit::bench {

constexpr double unmeasured = std::numeric_limits<double>::quiet_NaN();

/// What came to `total` with each of `count` things, steps mostly; unmeasured if there were none.
template <class Count>
double each(double total, Count count) {
  return count > 0 ? total / static_cast<double>(count) : unmeasured;
}

inline std::string cell(double value, int decimals) {
  if (!std::isfinite(value)) return "-";
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

/// The median, and the quartiles in brackets.
inline std::string cell(const common::Summary& of, int decimals) {
  if (!std::isfinite(of.median)) return "-";
  return cell(of.median, decimals) + " (" + cell(of.low, decimals) + ".." +
         cell(of.high, decimals) + ")";
}

/// The geometric mean of those that were measured.
inline double mean_of(const std::vector<double>& gains) {
  double logs = 0;
  std::size_t count = 0;
  for (const double gain : gains) {
    if (!std::isfinite(gain)) continue;
    logs += std::log(gain);
    ++count;
  }
  return count > 0 ? std::exp(logs / static_cast<double>(count)) : unmeasured;
}

/// The least of those that were measured.
inline double worst_of(const std::vector<double>& gains) {
  double worst = unmeasured;
  for (const double gain : gains) worst = std::fmin(worst, gain);
  return worst;
}

}  // namespace navjit::bench
