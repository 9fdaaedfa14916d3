// From chosen scenes to code that is installed. Private to runtime/.
#pragma once

#include <vector>

#include "codegen/module.hpp"
#include "runtime/specialisation.hpp"

namespace navjit {

/// `along_faces`: with code for rays along faces and from within daughters. `leaves`: whether those
/// that can share their code do.
codegen::Module generate(Specialisation& spec, const std::vector<VolumeId>& batch, bool along_faces,
                         codegen::Leaves leaves);

/// After a failure to compile: whether nothing can be compiled in this process. Says so in the log.
bool nothing_more(Specialisation& spec, const Failure& failure);

/// From the cache, or compiled; then installed. False if the module could not be made; its scenes
/// were then tried alone.
bool make_module(Specialisation& spec, const std::vector<VolumeId>& batch);

}  // namespace navjit
