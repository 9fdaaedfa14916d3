// Converts doubles to floats that are certainly below or above them.
#pragma once

#include <cmath>
#include <limits>

namespace navjit::bvh {

/// A float strictly below `x`; -infinity if there is no finite one. `x` may be infinite, not NaN.
///
/// The margin m = |x| 2^-23 + 2^-100 exceeds the error of the conversion, which is at most 2^-24 (1
/// + 2^-23) |x|, plus 2^-126 where subnormal floats are flushed. The 2^-100 also keeps the result
/// away from x where x is zero or subnormal, whether floats are flushed or not.
inline float float_below(double x) {
  if (std::isinf(x)) return x < 0 ? static_cast<float>(x) : std::numeric_limits<float>::max();
  const double shifted = x - (std::fabs(x) * 0x1p-23 + 0x1p-100);
  constexpr double largest = std::numeric_limits<float>::max();
  return static_cast<float>(shifted < largest ? shifted : largest);
}

/// A float strictly above `x`; +infinity if there is no finite one. `x` may be infinite, not NaN.
inline float float_above(double x) { return -float_below(-x); }

/// The same bits without a branch, for |x| up to 1e30 (above: for any positive x, infinity
/// included). They are for points, of which each search rounds six coordinates, and for limits.
inline float float_below_point(double x) {
  return static_cast<float>(x - (std::fabs(x) * 0x1p-23 + 0x1p-100));
}
inline float float_above_point(double x) {
  return static_cast<float>(x + (std::fabs(x) * 0x1p-23 + 0x1p-100));
}

}  // namespace navjit::bvh
