// The kernels as text, embedded at build time from geometry/kernels.
#pragma once

#include <string_view>

namespace navjit::codegen {

/// The text of geometry/kernels/NAME.h; empty if there is no such kernel.
std::string_view kernel_text(std::string_view name);

}  // namespace navjit::codegen
