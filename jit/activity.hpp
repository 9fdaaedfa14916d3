// What becomes of threads that are at work in LLVM when the process ends.
#pragma once

#include <list>
#include <stop_token>

namespace navjit::jit {

/// While one exists, the process does not come to the end of exit(): that destroys LLVM's static
/// objects, and a thread in LLVM would crash. exit(), also by a return from main, asks all
/// activities to stop and waits until they are gone; _exit() and quick_exit() wait for nobody. The
/// child of a fork() has none of its parent's.
///
/// A thread that uses a `Compiler` or a `Linker` and may still do so when the process ends makes
/// one before them, as its first local variable, and heeds the request. Thread-safe.
class Activity {
 public:
  /// Throws std::bad_alloc.
  explicit Activity(const std::stop_source& stop);
  Activity(const Activity&) = delete;
  Activity& operator=(const Activity&) = delete;
  ~Activity();

  /// Whether there is any in this process: then exit() may take a while.
  static bool any();

 private:
  std::list<std::stop_source>::iterator place_;
};

/// Has exit() wait for the activities before it destroys any static object that was made until now:
/// to be called where an activity is left to itself.
void outlast_activities();

/// The same for all static objects, also those that are made later, if the calling thread is the
/// one that will call exit(): to be called by threads that might. If the thread only ends, that
/// waits for nothing. Further calls by a thread cost nothing. Throws std::bad_alloc.
void outlast_by_this_thread();

/// The same as outlast_activities() for static objects that LLVM makes later, when it first needs
/// them: to be called often while something is compiled. Where exit() is called by a thread that
/// has called neither of the functions above, there is nothing but this: such a thread may destroy,
/// before the compiler has stopped, what the compiler has made in its last fraction of a
/// millisecond.
void outlast_static_objects();

}  // namespace navjit::jit
