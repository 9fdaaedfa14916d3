// Linked code into the dispatch table: verified, timed, published. Private to runtime/.
#pragma once

#include <string>
#include <vector>

#include "codegen/module.hpp"
#include "jit/linker.hpp"
#include "runtime/specialisation.hpp"

namespace navjit {

/// Adds a module to the report. `start`: when making it began, by steady_seconds().
void count_module(Specialisation& spec, bool cached, std::size_t code_bytes, double start);

/// Verifies a module's code and installs what is good of it. Returns false if some of it is wrong.
/// For code from the cache it returns at the first wrong function, and notes no failure. `start`:
/// when making it began, by steady_seconds().
bool install(Specialisation& spec, const codegen::Module& module, jit::Code code, bool cached,
             double start);

/// The same for code of a structure, in all scenes that have it. `scenes`: the modules of these;
/// the code was compiled from the first one's source.
bool install_structure(Specialisation& spec, const std::vector<codegen::Module>& scenes,
                       jit::Code code, bool cached, double start);

/// Verifies and installs the scenes of a plugin. What is wrong with it is a warning in the log.
void install_plugin(Specialisation& spec, const std::string& path);

}  // namespace navjit
