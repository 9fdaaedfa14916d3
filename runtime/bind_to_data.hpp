// Gives scenes navigators that were compiled with the library, with the scenes' own numbers.
// Private to runtime/.
#pragma once

#include "runtime/specialisation.hpp"

namespace navjit {

/// Binds hot scenes that are not bound yet to data, the hottest first, for some milliseconds.
/// Returns true if some are left.
bool bind_hot_to_data(Specialisation& spec);

/// Binds all scenes of the tree, hot or not.
void bind_all_to_data(Specialisation& spec);

/// Binds the scene to data: verifies, times and installs a navigator of the library with this
/// scene's numbers, if it is faster than the generic one on the states at hand.
void bind_to_data(Specialisation& spec, VolumeId volume);

/// The time of a step, in ns, of the installed navigator that is bound to data or to a structure;
/// infinite if there is none, or if it was not timed.
double bound_ns(const Specialisation& spec, VolumeId volume);

}  // namespace navjit
