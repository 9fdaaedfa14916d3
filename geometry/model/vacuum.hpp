// What counts as a vacuum.
#pragma once

namespace navjit {

/// A material without elements whose density, in g/cm3, is no more than this is a vacuum: a
/// kilometre of it stops nothing.
constexpr double most_density_of_vacuum = 1e-9;

}  // namespace navjit
