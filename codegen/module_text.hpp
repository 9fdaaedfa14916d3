// The text that all modules have around their scenes.
#pragma once

#include <string>

#include "codegen/module.hpp"
#include "codegen/shapes.hpp"

namespace navjit::codegen {

/// The exported functions of an entry, whose scene has the type `scene`.
std::string entry_functions(const Entry& entry, const std::string& scene);

/// The beginning of all modules: the kernels of scenes and of common solids. A compiler may keep it
/// parsed (jit::CompileOptions::preamble).
const std::string& common_text();

/// A whole module: the common text, the other kernels for these shapes, the title as a comment,
/// `types` in an unnamed namespace, and `functions`.
std::string module_text(const std::string& title, const Shapes& shapes, const std::string& types,
                        const std::string& functions);

}  // namespace navjit::codegen
