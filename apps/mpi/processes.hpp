// The processes of one run that a launcher of MPI started.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/mpi/world.hpp"

namespace navjit::apps {

/// All processes make the same calls in the same order. A signal to one is a signal to all
/// (common/interruption.hpp), and what one throws in together() ends all. Alone it does nothing,
/// and MPI is not touched.
class Processes {
 public:
  /// Those that a launcher started together with this one (launcher.hpp); nothing if it is alone.
  /// Throws Error if this program cannot find them: it is built without MPI, or with another one.
  static std::unique_ptr<mpi::World> of_launcher();

  /// With these; nothing: alone.
  explicit Processes(std::unique_ptr<mpi::World> world) : world_(std::move(world)) {}
  Processes(const Processes&) = delete;
  Processes& operator=(const Processes&) = delete;

  unsigned rank() const { return world_ ? world_->rank() : 0; }
  unsigned count() const { return world_ ? world_->count() : 1; }
  bool several() const { return count() > 1; }
  bool first() const { return rank() == 0; }

  /// Does the work, and waits until all have done theirs. Where it failed in one, throws in all: in
  /// the first process, which speaks for all, what was thrown there, or an Error that says in which
  /// process what was wrong.
  void together(const std::function<void()>& work);

  /// Set once another process has failed: what this one makes in together() is then in vain.
  const std::atomic<bool>& in_vain() const { return in_vain_; }

  /// In the first process the texts of all, by rank; nothing in others.
  std::vector<std::string> gather(const std::string& mine);

 private:
  void hear();
  void tell_others(const std::string& why);
  void deliver(unsigned to, int kind, const std::string& text);
  std::string await(unsigned from, int kind);
  std::string verdict_on(const std::string& own);

  std::unique_ptr<mpi::World> world_;
  std::atomic<bool> in_vain_{false};
  bool signal_is_known_ = false;
};

}  // namespace navjit::apps
