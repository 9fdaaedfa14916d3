#pragma once

#include <optional>
#include <string_view>

#include "navjit/detail/expected.hpp"

namespace navjit::jit::detail {

/// Refuses source that would exhaust the stack of the compiler, which recurses with the length of
/// an expression where it does not with the nesting of brackets (that it limits itself). Looks at
/// the text as written, so macros can defeat it: a safeguard against accidents, not attacks.
std::optional<Failure> too_deep(std::string_view source, std::string_view unit_name);

}  // namespace navjit::jit::detail
