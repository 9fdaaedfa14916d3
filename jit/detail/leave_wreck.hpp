#pragma once

#include <memory>

namespace navjit::jit::detail {

/// Calls work(*state) and then destroys the state. LLVM and Clang are not made for exceptions. If
/// one passes through them, because memory is exhausted, the state that it leaves behind cannot be
/// destroyed. The state is then never freed.
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
