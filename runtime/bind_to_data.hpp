// Scenes get navigators that were compiled with the library, with their own numbers. Private to
// runtime/.
#pragma once

#include "runtime/specialisation.hpp"

namespace navjit {

/// Binds what is hot and not bound yet, the hottest first, for some ms. True if more is left.
bool bind_hot_to_data(Specialisation& spec);

/// Binds all scenes of the tree, hot or not.
void bind_all_to_data(Specialisation& spec);

/// Verifies, times and installs a navigator of the library with this scene's numbers, if it is
/// faster than the generic one on the states at hand.
void bind_to_data(Specialisation& spec, VolumeId volume);

/// Of a step of the navigator bound to data or to a structure that is installed, ns; infinite if
/// none is, or nobody timed it.
double bound_ns(const Specialisation& spec, VolumeId volume);

}  // namespace navjit
