// Gives code to scenes of structures for which the library has no instance. It is compiled once for
// each structure. Private to runtime/.
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
  double spent_ns = 0;    ///< spent in steps and relocations in the scenes
  double paid = 0;        ///< how many times that time has paid for compiling the structure
};

/// The structure with the largest ratio of the time spent in its scenes to its expected compile
/// time; nothing if the time spent has not paid for compiling it.
std::optional<DueStructure> due_structure(Specialisation& spec);
/// The same over all scenes of the tree, however little time was spent in them.
std::optional<DueStructure> any_structure(Specialisation& spec);

/// Compiles the structure and installs it in its scenes. Returns true if there may be another to
/// compile.
bool bind_to_structure(Specialisation& spec, const DueStructure& structure);

}  // namespace navjit
