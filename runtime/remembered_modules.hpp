// Modules that earlier runs of a detector made, according to the list in the cache. Private to
// runtime/.
#pragma once

#include <vector>

#include "runtime/specialisation.hpp"

namespace navjit {

/// Installs the modules that earlier runs made, if the cache has their code.
void install_remembered(Specialisation& spec);

/// Makes a module of those scenes of a batch that are worth compiling, and adds it to the list.
void make_and_remember(Specialisation& spec, const std::vector<VolumeId>& batch);

}  // namespace navjit
