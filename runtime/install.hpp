// Linked code into the dispatch table: verified, timed, published. Private to runtime/.
#pragma once

#include <string>
#include <vector>

#include "codegen/module.hpp"
#include "jit/linker.hpp"
#include "runtime/specialisation.hpp"

namespace navjit {

/// Adds a module to the report. `start`: of making it, steady_seconds().
void count_module(Specialisation& spec, bool cached, std::size_t code_bytes, double start);

/// Verifies and installs what is good of a module. False if something is not; where the code came
/// from the cache it ends there, and notes no failure. `start`: of making it, steady_seconds().
bool install(Specialisation& spec, const codegen::Module& module, jit::Code code, bool cached,
             double start);

/// Code of a structure and the modules of all scenes that have it, the first being what it was made
/// from. False if it is wrong for any of them.
bool install_structure(Specialisation& spec, const std::vector<codegen::Module>& scenes,
                       jit::Code code, bool cached, double start);

/// Verifies and installs the scenes of a plugin. What is wrong with it is a warning in the log.
void install_plugin(Specialisation& spec, const std::string& path);

}  // namespace navjit
