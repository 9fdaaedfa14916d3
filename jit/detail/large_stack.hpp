#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "navjit/detail/expected.hpp"

namespace navjit::jit::detail {

/// The stack of the compiler: parsing and code generation recurse with the nesting of expressions.
/// Only pages that are touched take memory.
constexpr std::size_t stack_bytes = std::size_t{256} << 20;

/// Runs `work` on a thread with `bytes` of stack and waits for it. `work` must not throw. Fails as
/// exhausted, without running `work`, if no such thread can be made.
std::optional<Failure> run_on_large_stack(std::size_t bytes, const std::function<void()>& work);

}  // namespace navjit::jit::detail
