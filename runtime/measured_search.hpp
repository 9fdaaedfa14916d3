// How daughters are found in a scene, where the run knows better than the analysis. Which way is
// the fastest depends on the rays: slabs that each of them meets are walked in no time, and the
// same slabs in a hall that most rays pass beside them are walked to the end for nothing. So a
// scene is bound to data in several ways, which are timed (runtime/bind_to_data.hpp), and code for
// it finds daughters as the fastest of them does, but where it spells out every daughter. Private
// to runtime/.
#pragma once

#include "runtime/specialisation.hpp"

namespace navjit {

/// The plan as the analysis makes it, or as the environment forces it, whatever was measured.
ScenePlan plan_without_measurement(Specialisation& spec, VolumeId volume);

/// To be called where what is bound to data in a volume was chosen, or chosen anew: code for the
/// volume, and for all equal ones, is to find daughters in the same way, if it can and does not
/// spell them out.
void search_as_bound(Specialisation& spec, VolumeId volume);

/// The same as an earlier run measured it, until something is bound.
void search_as_listed(Specialisation& spec, const ListedScene& scene);

/// What later runs are to know of the scene, whose code was made.
ListedScene to_be_listed(const Specialisation& spec, VolumeId volume);

}  // namespace navjit
