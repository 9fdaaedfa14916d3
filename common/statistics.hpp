// Medians and their spread.
#pragma once

#include <algorithm>
#include <vector>

namespace navjit::common {

/// The q-quantile (0..1) of values, linearly interpolated; 0 for none.
inline double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const double at = q * static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  const std::size_t high = std::min(low + 1, values.size() - 1);
  return values[low] + (at - static_cast<double>(low)) * (values[high] - values[low]);
}

struct Summary {
  double median, low, high;  ///< quartiles
};

inline Summary summarise(const std::vector<double>& values) {
  return {quantile(values, 0.5), quantile(values, 0.25), quantile(values, 0.75)};
}

/// The ratios a[i] / b[i], value by value: for repetitions that were made in turn.
inline Summary ratio(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) ratios.push_back(a[i] / b[i]);
  return summarise(ratios);
}

}  // namespace navjit::common
