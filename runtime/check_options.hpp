// Checks the options of a Runtime. Private to runtime/.
#pragma once

#include "navjit/options.hpp"

namespace navjit {

/// The options, with all that depends on the present moment settled: a relative cache directory is
/// that of the present working directory. Throws UsageError, naming the option, if a number makes
/// no sense.
RuntimeOptions checked(RuntimeOptions options);

}  // namespace navjit
