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

/// Asks the activities to stop at exit() even before static objects are destroyed that were made
/// since the activity was: to be called where an activity is left to itself.
void outlast_activities();

/// The same, and before any static object is destroyed, if the calling thread is the one that will
/// call exit(): to be called by threads that might. The end of the thread itself waits for
/// nothing. Calls after the first cost nothing.
void outlast_by_this_thread();

/// The same for static objects of LLVM, which it makes when it first needs them: to be called often
/// while something is compiled. It is all there is for a thread that calls exit() and has called
/// neither of the functions above: such a thread may destroy, before the compiler has stopped, what
/// that has made in its last fraction of a millisecond.
void outlast_static_objects();

}  // namespace navjit::jit
