// What happens to threads that are at work in LLVM when the process ends.
#pragma once

#include <list>
#include <stop_token>

namespace navjit::jit {

/// While an activity exists, the process does not complete exit(). exit() destroys LLVM's static
/// objects, and a thread that is at work in LLVM would then crash. Therefore exit(), also by a
/// return from main, asks all activities to stop and waits until they are gone. _exit() and
/// quick_exit() wait for nothing. The child of a fork() has none of its parent's activities.
///
/// A thread that uses a `Compiler` or a `Linker`, and may still do so when the process ends, makes
/// an activity first, as its first local variable, and heeds the request to stop. Thread-safe.
class Activity {
 public:
  /// Throws std::bad_alloc.
  explicit Activity(const std::stop_source& stop);
  Activity(const Activity&) = delete;
  Activity& operator=(const Activity&) = delete;
  ~Activity();

  /// Whether there are any activities in this process. If so, exit() may take a while.
  static bool any();

 private:
  std::list<std::stop_source>::iterator place_;
};

/// Makes exit() wait for the activities before it destroys any static object that exists by now.
/// Must be called where nobody waits for an activity.
void outlast_activities();

/// The same for all static objects, also those that are made later, if the calling thread is the
/// one that will call exit(). Must be called by threads that may do so. If the thread merely ends,
/// it waits for nothing. Further calls by a thread cost nothing. Throws std::bad_alloc.
void outlast_by_this_thread();

/// The same as outlast_activities() for static objects that LLVM makes later, when it first needs
/// them. Must be called often while something is compiled. It is the only protection if exit() is
/// called by a thread that has called neither of the functions above. Such a thread may destroy
/// what the compiler has made in its last fraction of a millisecond before the compiler has
/// stopped.
void outlast_static_objects();

}  // namespace navjit::jit
