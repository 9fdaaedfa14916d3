// Whether a thread is ending the whole process, or only itself.
#pragma once

namespace navjit::jit {

/// Whether the calling thread is inside exit(), also by a return from main. False if this cannot be
/// known: in programs that are linked statically with the C library. It walks up the call stack. It
/// is for destructors of thread-local objects, which are called both by exit() and at the end of
/// the thread.
bool is_exiting() noexcept;

}  // namespace navjit::jit
