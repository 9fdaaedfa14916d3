// Generated code is not instrumented: the thread sanitizer does not see it load a record from the
// dispatch table, and takes what the record points to for a race. Both sides tell it; elsewhere
// this is nothing.
#pragma once

#ifdef __SANITIZE_THREAD__
extern "C" void __tsan_acquire(void*);
extern "C" void __tsan_release(void*);
#endif

namespace navjit {

/// By who made it: what is there is complete, before other threads are shown the address.
inline void tell_published([[maybe_unused]] const void* address) {
#ifdef __SANITIZE_THREAD__
  __tsan_release(const_cast<void*>(address));
#endif
}

/// By who was given the address.
inline void tell_received([[maybe_unused]] const void* address) {
#ifdef __SANITIZE_THREAD__
  __tsan_acquire(const_cast<void*>(address));
#endif
}

}  // namespace navjit
