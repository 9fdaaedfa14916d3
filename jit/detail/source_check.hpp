#pragma once

#include <optional>
#include <string_view>

#include "navjit/detail/expected.hpp"

namespace navjit::jit::detail {

/// Refuses source that would exhaust the stack of the compiler. The compiler recurses with the
/// length of an expression; it limits only the nesting of brackets itself. This looks at the text
/// as written, so macros can defeat it. It protects against accidents, not against attacks.
std::optional<Failure> too_deep(std::string_view source, std::string_view unit_name);

}  // namespace navjit::jit::detail
