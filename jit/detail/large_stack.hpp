#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "navjit/detail/expected.hpp"

namespace navjit::jit::detail {

/// For the compiler: parsing and code generation recurse with the nesting of expressions. Only
/// touched pages cost.
constexpr std::size_t stack_bytes = std::size_t{256} << 20;

/// Runs `work` on a thread with `bytes` of stack and waits for it. `work` must not throw.
/// Fails as exhausted, without having run it, if there is no such thread to be had.
std::optional<Failure> run_on_large_stack(std::size_t bytes, const std::function<void()>& work);

}  // namespace navjit::jit::detail
