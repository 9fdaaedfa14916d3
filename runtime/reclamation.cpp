#include "runtime/reclamation.hpp"

#include <linux/membarrier.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace navjit {
namespace {

bool membarrier(int command) { return syscall(SYS_membarrier, command, 0, 0) == 0; }

}  // namespace

Graveyard::Graveyard() : can_free_(membarrier(MEMBARRIER_CMD_REGISTER_PRIVATE_EXPEDITED)) {}

void Graveyard::retire(std::shared_ptr<const void> garbage,
                       const std::vector<std::shared_ptr<Presence>>& threads) {
  // After the barrier every thread either sees the new pointer or has its entry mark seen here.
  can_free_ = can_free_ && membarrier(MEMBARRIER_CMD_PRIVATE_EXPEDITED);
  Grave grave{std::move(garbage), {}};
  for (const auto& thread : threads) {
    const std::uint64_t passage = thread->passages.load(std::memory_order_acquire);
    if (passage % 2 == 1) grave.waits.push_back({thread, passage});
  }
  graves_.push_back(std::move(grave));
  sweep();
}

std::size_t Graveyard::sweep() {
  if (!can_free_) return graves_.size();
  std::erase_if(graves_, [](Grave& grave) {
    std::erase_if(grave.waits, [](const Wait& wait) {
      return wait.thread->passages.load(std::memory_order_acquire) != wait.passage;
    });
    return grave.waits.empty();
  });
  return graves_.size();
}

}  // namespace navjit
