#include "bench/agreement.hpp"

#include <cmath>

namespace navjit::bench {

std::vector<Passed> without_short_steps(std::span<const Passed> steps, double shortest) {
  std::vector<Passed> kept;
  for (const Passed& step : steps) {
    if (step.length > shortest || kept.empty()) {
      kept.push_back(step);
    } else {
      kept.back().length += step.length;
    }
  }
  // The first step may be short itself, and has no step before it.
  if (kept.size() > 1 && kept.front().length <= shortest) {
    kept[1].length += kept[0].length;
    kept.erase(kept.begin());
  }
  return kept;
}

bool agree(std::span<const Passed> a, std::span<const Passed> b, double tolerance) {
  const std::vector<Passed> left = without_short_steps(a, 2 * tolerance);
  const std::vector<Passed> right = without_short_steps(b, 2 * tolerance);
  if (left.size() != right.size()) return false;
  double at_left = 0, at_right = 0;
  for (std::size_t i = 0; i < left.size(); ++i) {
    at_left += left[i].length;
    at_right += right[i].length;
    if (left[i].volume != right[i].volume || std::abs(at_left - at_right) > tolerance) return false;
  }
  return true;
}

}  // namespace navjit::bench
