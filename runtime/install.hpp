// Verifies and times linked code, and puts it into the dispatch table. Private to runtime/.
#pragma once

#include <string>
#include <vector>

#include "codegen/module.hpp"
#include "jit/linker.hpp"
#include "runtime/specialisation.hpp"

namespace navjit {

/// Adds a module to the report. `start` is the time at which making it began, by steady_seconds().
void count_module(Specialisation& spec, bool cached, std::size_t code_bytes, double start);

/// Verifies a module's code and installs those parts of it that are right. Returns false if a part
/// is wrong. For code from the cache it returns at the first wrong function, and notes no failure.
/// `start` is the time at which making the module began, by steady_seconds().
bool install(Specialisation& spec, const codegen::Module& module, jit::Code code, bool cached,
             double start);

/// The same for the code of a structure, in all scenes that have it. `scenes` are the modules of
/// these scenes; the code was compiled from the source of the first one.
bool install_structure(Specialisation& spec, const std::vector<codegen::Module>& scenes,
                       jit::Code code, bool cached, double start);

/// Verifies and installs the scenes of a plugin. Any trouble with the plugin is a warning in the
/// log.
void install_plugin(Specialisation& spec, const std::string& path);

}  // namespace navjit
