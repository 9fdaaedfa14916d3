// What a Runtime can be told, and what it cannot. Private to runtime/.
#pragma once

#include "navjit/options.hpp"

namespace navjit {

/// The options, with what depends on the moment settled: a relative cache directory is that of now.
/// Throws UsageError, naming the option, if a number makes no sense.
RuntimeOptions checked(RuntimeOptions options);

}  // namespace navjit
