#pragma once

#include <memory>

namespace navjit::jit::detail {

/// Calls work(*state) and destroys the state after it. LLVM and Clang are not made for exceptions:
/// one that passes through them, for want of memory, leaves behind what nobody can take down any
/// more. Then the state stays where it is, for good.
template <class State, class Work>
auto leave_wreck(std::unique_ptr<State> state, Work&& work) {
  try {
    return work(*state);
  } catch (...) {
    (void)state.release();
    throw;
  }
}

}  // namespace navjit::jit::detail
