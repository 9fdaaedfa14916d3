// What the texts of all modules have around their scenes.
#pragma once

#include <string>

#include "codegen/module.hpp"
#include "codegen/shapes.hpp"

namespace navjit::codegen {

/// The functions that can be looked up, for the scene of that type.
std::string entry_functions(const Entry& entry, const std::string& scene);

/// What the texts of all modules begin with: the kernels of scenes and of common solids. A compiler
/// may keep it parsed (jit::CompileOptions::preamble).
const std::string& common_text();

/// That and the other kernels for these shapes, the title as a comment, then `types` where nothing
/// else sees them, then `functions`.
std::string module_text(const std::string& title, const Shapes& shapes, const std::string& types,
                        const std::string& functions);

}  // namespace navjit::codegen
