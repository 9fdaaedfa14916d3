// How a program ends that may still be compiling.
#pragma once

namespace navjit::common {

/// Ends the process with this status, once all that is to be written is written. Where a
/// compilation is under way nothing waits for it, as exit() would (jit/activity.hpp).
[[noreturn]] void leave(int status);

}  // namespace navjit::common
