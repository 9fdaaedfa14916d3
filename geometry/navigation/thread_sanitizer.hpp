// Generated code is not instrumented: the thread sanitizer does not see it load an entry from the
// dispatch table, and reports a race on what the entry points to. So both sides tell the sanitizer;
// in other builds these functions do nothing.
#pragma once

#ifdef __SANITIZE_THREAD__
extern "C" void __tsan_acquire(void*);
extern "C" void __tsan_release(void*);
#endif

namespace navjit {

/// Called by the maker: all of it is complete before other threads see the address.
inline void tell_published([[maybe_unused]] const void* address) {
#ifdef __SANITIZE_THREAD__
  __tsan_release(const_cast<void*>(address));
#endif
}

/// Called by a thread that was given the address.
inline void tell_received([[maybe_unused]] const void* address) {
#ifdef __SANITIZE_THREAD__
  __tsan_acquire(const_cast<void*>(address));
#endif
}

}  // namespace navjit
