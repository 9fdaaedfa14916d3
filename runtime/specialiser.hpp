// The background thread that looks at the profile, decides, generates, compiles, verifies and
// installs.
#pragma once

#include <unistd.h>

#include <memory>
#include <thread>

#include "jit/over_fork.hpp"
#include "navjit/step_profile.hpp"
#include "runtime/specialisation.hpp"

namespace navjit {

/// Owned by its Runtime, and by its own thread as long as that runs.
class Specialiser : public std::enable_shared_from_this<Specialiser> {
 public:
  explicit Specialiser(std::shared_ptr<detail::Shared> shared);

  /// Specialises all volumes of the tree, in the calling thread. Only before start().
  void specialise_all();
  /// Starts the thread. If no thread can be made, nothing is specialised, and the log says so.
  void start();
  void wait_until_idle();
  /// Ends the thread. A compilation that is under way is asked to stop; nobody waits for it, and
  /// its result is dropped. Returns true if the calling thread may then use the data of the thread.
  /// Returns false in the child of a fork(): the thread is only in the parent, and may have been
  /// changing the data.
  bool stop();
  /// How often each volume was used so far. May be called while the thread and navigators are at
  /// work, but by one thread at a time.
  StepProfile step_profile();

  /// The data that the functions of runtime/ work on. From start() to stop() they belong to the
  /// thread, except for those that their mutex guards.
  Specialisation& specialisation() { return spec_; }
  const Specialisation& specialisation() const { return spec_; }

 private:
  void run();
  void look_until_stopped();
  /// Whether this process is a child of the process in which this was made, and so has no such
  /// thread.
  bool was_forked() const { return thread_.joinable() && process_ != getpid(); }

  Specialisation spec_;
  pid_t process_ = getpid();
  jit::OverFork over_fork_;

  // Guarded by the mutex of `spec_`:
  bool ended_ = false;           ///< the thread does not use anything any more
  std::uint64_t looks_ = 0;      ///< completed passes over the profile
  std::uint64_t idle_look_ = 0;  ///< the last look that found nothing to do
  int waiting_for_idle_ = 0;     ///< threads in wait_until_idle()

  std::thread thread_;
  std::thread* left_behind_ = nullptr;  ///< in a forked child: the parent's thread; never destroyed
};

}  // namespace navjit
