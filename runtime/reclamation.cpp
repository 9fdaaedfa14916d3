#include "runtime/reclamation.hpp"

#include <linux/membarrier.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace navjit {
namespace {

bool membarrier(int command) { return syscall(SYS_membarrier, command, 0, 0) == 0; }

}  // namespace

RetireList::RetireList() : can_free_(membarrier(MEMBARRIER_CMD_REGISTER_PRIVATE_EXPEDITED)) {}

void RetireList::retire(std::shared_ptr<const void> garbage,
                        const std::vector<std::shared_ptr<ReadSide>>& threads) {
  // After the barrier, every thread either sees the new pointer, or its entry mark is seen here.
  can_free_ = can_free_ && membarrier(MEMBARRIER_CMD_PRIVATE_EXPEDITED);
  Retired retired{std::move(garbage), {}};
  for (const auto& thread : threads) {
    const std::uint64_t section = thread->sections.load(std::memory_order_acquire);
    if (section % 2 == 1) retired.waits.push_back({thread, section});
  }
  retired_.push_back(std::move(retired));
  reclaim();
}

std::size_t RetireList::reclaim() {
  if (!can_free_) return retired_.size();
  std::erase_if(retired_, [](Retired& retired) {
    std::erase_if(retired.waits, [](const Wait& wait) {
      return wait.thread->sections.load(std::memory_order_acquire) != wait.section;
    });
    return retired.waits.empty();
  });
  return retired_.size();
}

}  // namespace navjit
