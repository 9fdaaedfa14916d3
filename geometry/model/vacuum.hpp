// What counts as a vacuum.
#pragma once

namespace navjit {

/// A material of no elements and of no more than this is a vacuum, g/cm3: a kilometre of it stops
/// nothing.
constexpr double most_density_of_vacuum = 1e-9;

}  // namespace navjit
