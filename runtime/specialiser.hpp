// The background thread: looks at the profile, decides, generates, compiles, verifies, installs.
#pragma once

#include <memory>
#include <thread>

#include "runtime/specialisation.hpp"

namespace navjit {

/// Owned by its Runtime, and by its thread as long as that runs.
class Specialiser : public std::enable_shared_from_this<Specialiser> {
 public:
  explicit Specialiser(std::shared_ptr<detail::Shared> shared);

  /// Specialises all volumes of the tree, in the calling thread. Before start() only.
  void specialise_all();
  /// Where there is no thread to be had, nothing is specialised, and the log says so.
  void start();
  void wait_until_idle();
  /// Ends the thread. A compilation that is under way is asked to stop and left to itself, and
  /// whatever comes of it is dropped. The calling thread may use what is the thread's from then on.
  void stop();

  /// What the functions of runtime/ work on: the thread's own from start() to stop(), but for what
  /// its mutex guards.
  Specialisation& specialisation() { return spec_; }
  const Specialisation& specialisation() const { return spec_; }

 private:
  void run();
  void look_until_stopped();

  Specialisation spec_;

  // Guarded by the mutex of `spec_`:
  bool ended_ = false;           ///< the thread uses nothing any more
  std::uint64_t looks_ = 0;      ///< completed passes over the profile
  std::uint64_t idle_look_ = 0;  ///< the last that found nothing to do
  int waiting_for_idle_ = 0;     ///< threads

  std::thread thread_;
};

}  // namespace navjit
