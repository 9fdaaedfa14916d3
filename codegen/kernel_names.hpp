// How each kind of solid is spelled in generated code.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/solids/solid.hpp"

namespace navjit::codegen {

/// The kernel files that a kind needs besides the prelude, without those of its operands.
std::span<const char* const> kernels_of(SolidKind kind);
/// The type of a kind that is not made of other solids, in namespace navjit::kernels.
std::string shape_type(SolidKind kind);
/// All kernel files of solids, in the order in which they have to appear.
std::vector<std::string_view> kernel_order();

/// The kernel files that scenes need besides those of solids, in order; without the scene itself.
std::span<const char* const> scene_kernels();

/// Whether a kernel file is small enough to be inlined at every call.
bool inlines_everywhere(std::string_view kernel);

}  // namespace navjit::codegen
