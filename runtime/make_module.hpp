// From chosen scenes to code that is installed. Private to runtime/.
#pragma once

#include <vector>

#include "codegen/module.hpp"
#include "runtime/specialisation.hpp"

namespace navjit {

/// Generates the module of these scenes. `along_faces`: with code for rays along faces and from
/// within daughters. `leaves`: whether leaves that can share code do.
codegen::Module generate(Specialisation& spec, const std::vector<VolumeId>& batch, bool along_faces,
                         codegen::Leaves leaves);

/// To be called after a failure to compile. Returns whether nothing more can be compiled in this
/// run, and then says so in the log.
bool nothing_more(Specialisation& spec, const Failure& failure);

/// Takes a module from the cache, or compiles it, and installs it. Returns false if it was not
/// made: because the run ended, or because it did not compile; then its scenes were tried alone.
bool make_module(Specialisation& spec, const std::vector<VolumeId>& batch);

}  // namespace navjit
