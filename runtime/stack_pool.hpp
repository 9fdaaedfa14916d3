// Navigation stacks for many tracks, each only as long as the detector is deep. Private to
// runtime/, except that every basket owns one.
#pragma once

#include <cstddef>
#include <memory>

#include "geometry/navigation/navigation_stack.hpp"

namespace navjit {

/// Stacks one after the other in memory, each on cache lines of its own. They never move, because a
/// stack has pointers into itself.
class StackPool {
 public:
  /// `levels` is the number of levels of the deepest touchable, including the world. At first all
  /// stacks are outside the world.
  StackPool(std::size_t stacks, int levels);

  std::size_t size() const { return size_; }
  NavigationStack& at(std::size_t i) {
    return *reinterpret_cast<NavigationStack*>(memory_.get() + i * stride_);
  }

 private:
  struct Free {
    void operator()(std::byte* memory) const;
  };
  std::size_t size_, stride_;
  std::unique_ptr<std::byte[], Free> memory_;
};

}  // namespace navjit
