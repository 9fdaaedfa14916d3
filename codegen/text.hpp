// Numbers and names as C++ text.
#pragma once

#include <string>
#include <string_view>

namespace navjit::codegen {

/// A double that reads back to the same bits: hexadecimal, or a builtin for infinities.
std::string number(double value);
/// The same for a float.
std::string float_number(float value);
/// A name from a file made harmless: letters, digits and underscores, at most 60 characters.
std::string identifier(std::string_view name);

}  // namespace navjit::codegen
