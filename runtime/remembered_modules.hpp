// Modules that earlier runs of a detector made, by the list of them in the cache. Private to
// runtime/.
#pragma once

#include <vector>

#include "runtime/specialisation.hpp"

namespace navjit {

/// Installs what earlier runs found hot, as far as the cache has the code.
void install_remembered(Specialisation& spec);

/// Makes a module of what of a batch is worth it, and puts it on the list.
void make_and_remember(Specialisation& spec, const std::vector<VolumeId>& batch);

}  // namespace navjit
