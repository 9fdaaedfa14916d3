// The little that navjit needs of MPI.
#pragma once

#include <memory>
#include <optional>
#include <string>

namespace navjit::apps::mpi {

/// "Open MPI v4.1.4"; empty where navjit is built without MPI.
std::string library();

/// All processes that were started together, and texts between them. One for each program; calls by
/// one thread at a time. Nothing here waits busily, as MPI's own calls do, which take a
/// processor each that others may need.
class World {
 public:
  /// Joins the others. Throws Error without MPI, or where several threads may not call MPI in turn.
  World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;
  /// Leaves MPI, once all processes do.
  ~World();

  unsigned rank() const { return rank_; }
  unsigned count() const { return count_; }

  /// On its way when this returns; the texts of one kind to one process arrive in order.
  void send(unsigned to, int kind, const std::string& text);
  /// Whether all texts have been sent.
  bool sent_all();

  /// The next text of this kind from a process, or from whichever, if it is there.
  std::optional<std::string> receive(unsigned from, int kind);
  std::optional<std::string> receive_from_any(int kind);

  /// Ends all processes at once.
  void abandon();

 private:
  struct Outbox;
  unsigned rank_ = 0, count_ = 1;
  std::unique_ptr<Outbox> outbox_;
};

}  // namespace navjit::apps::mpi
