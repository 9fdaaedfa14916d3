// What the texts of all modules have around their scenes.
#pragma once

#include <string>

#include "codegen/module.hpp"
#include "codegen/shapes.hpp"

namespace navjit::codegen {

/// The functions that can be looked up, for the scene of that type.
std::string entry_functions(const Entry& entry, const std::string& scene);

/// The kernels for these shapes, then `types` where nothing else sees them, then `functions`.
std::string module_text(const Shapes& shapes, const std::string& types,
                        const std::string& functions);

}  // namespace navjit::codegen
