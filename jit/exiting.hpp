// Whether a thread is on its way out of the whole process, or only at its own end.
#pragma once

namespace navjit::jit {

/// Whether the calling thread is inside exit(), be it by a return from main. False where that
/// cannot be known: in programs that are linked with the C library statically. It walks up the
/// stack, and is for destructors of objects of a thread, which exit() calls as the end of the
/// thread does.
bool is_exiting() noexcept;

}  // namespace navjit::jit
