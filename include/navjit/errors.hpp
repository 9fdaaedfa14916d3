// What navjit throws.
#pragma once

#include <stdexcept>

#include "navjit/detail/api.hpp"

namespace NAVJIT_API navjit {

/// Everything that navjit throws, except std::bad_alloc. what() is one line that says what is
/// wrong, where, and what to do.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A call that breaks a rule of its function: a direction that is no unit vector, a state of
/// another detector, a number that is not finite. Nothing was changed.
struct UsageError : Error {
  using Error::Error;
};

/// A detector that cannot exist: dimensions that make no solid, volumes that contain one another.
struct GeometryError : Error {
  using Error::Error;
};

/// A GDML file that cannot be read: "FILE:LINE: <element name='...'>: problem; what to do".
struct GdmlError : Error {
  using Error::Error;
};

}  // namespace navjit
