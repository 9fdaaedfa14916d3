// Scenes of structures that the library has no instance for get code that is compiled once for each
// structure. Private to runtime/.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "codegen/module.hpp"
#include "runtime/specialisation.hpp"

namespace navjit {

/// A structure that may be compiled, with the scenes that have it and are hot.
struct DueStructure {
  std::string source{};
  std::vector<codegen::Module> scenes{};
  double compile_ms = 0;  ///< expected
  double spent_ns = 0;    ///< steps and relocations in them, by the time of a step
  double paid = 0;        ///< how many times that has paid for compiling it
};

/// The one on which most was spent so far for what it costs; nothing if that has not paid for it.
std::optional<DueStructure> due_structure(Specialisation& spec);
/// The same whatever was spent, in all scenes of the tree.
std::optional<DueStructure> any_structure(Specialisation& spec);

/// Compiles it and installs it in its scenes. True if there may be another.
bool bind_to_structure(Specialisation& spec, const DueStructure& structure);

}  // namespace navjit
