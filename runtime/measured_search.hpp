// How daughters are found in a scene, where the run knows better than the analysis. Which search is
// the fastest depends on the rays: slabs that every ray meets are found at once, but where most
// rays pass beside the slabs each is walked to the end for nothing. So a scene is bound to data in
// several ways, which are timed (runtime/bind_to_data.hpp), and code for it finds daughters as the
// fastest of them does, unless the code spells out every daughter. Private to runtime/.
#pragma once

#include "runtime/specialisation.hpp"

namespace navjit {

/// The plan as the analysis makes it, or as the environment forces it, whatever was measured.
ScenePlan plan_without_measurement(Specialisation& spec, VolumeId volume);

/// To be called when the navigator of a volume that is bound to data was chosen, or chosen anew.
/// Code for the volume, and for all equal ones, then finds daughters in the same way, if it can and
/// does not spell them out.
void search_as_bound(Specialisation& spec, VolumeId volume);

/// The same with the search that an earlier run measured. It holds until something is bound in the
/// volume.
void search_as_listed(Specialisation& spec, const ListedScene& scene);

/// What later runs should know of a scene whose code was made.
ListedScene to_be_listed(const Specialisation& spec, VolumeId volume);

}  // namespace navjit
