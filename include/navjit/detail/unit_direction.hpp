// Which directions are accepted as unit vectors.
#pragma once

namespace navjit::detail {

/// How far from 1 the length of a direction may be: unit vectors in single precision pass.
constexpr double unit_slack = 1e-5;

/// False also where a component is infinite or not a number.
constexpr bool is_unit_vector(double u, double v, double w) {
  const double off = u * u + v * v + w * w - 1;
  return (off <= 2 * unit_slack) & (off >= -2 * unit_slack);
}

}  // namespace navjit::detail
