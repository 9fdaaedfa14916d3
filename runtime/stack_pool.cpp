#include "runtime/stack_pool.hpp"

#include <cstring>
#include <limits>
#include <new>

#include "navjit/errors.hpp"

namespace navjit {
namespace {

constexpr std::align_val_t line{64};

std::size_t bytes_of(int levels) {
  const std::size_t bytes =
      offsetof(NavigationStack, levels) + static_cast<std::size_t>(levels) * sizeof(StackLevel);
  return (bytes + 63) / 64 * 64;
}

}  // namespace

void StackPool::Free::operator()(std::byte* memory) const { ::operator delete[](memory, line); }

StackPool::StackPool(std::size_t stacks, int levels) : size_(stacks), stride_(bytes_of(levels)) {
  if (stacks > std::numeric_limits<std::ptrdiff_t>::max() / stride_) throw std::bad_alloc();
  memory_.reset(static_cast<std::byte*>(::operator new[](stacks* stride_, line)));
  for (std::size_t i = 0; i < stacks; ++i) {
    // Only the part of a stack for which there is memory is cleared. Levels are written before they
    // are read.
    NavigationStack& stack = at(i);
    std::memset(static_cast<void*>(&stack), 0, stride_);
    stack.depth = -1;
    // No step has this direction, so that the direction of the first step is checked, too.
    for (double& given : stack.ray.given) given = std::numeric_limits<double>::signaling_NaN();
  }
}

}  // namespace navjit
