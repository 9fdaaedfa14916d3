// The search of a scene as the run measured it. Which search is the fastest depends on the rays:
// slabs that every ray meets are found at once, but if most rays pass beside the slabs, each of
// these walks to the end of the row for nothing. So a scene is bound to data in several ways, which
// are timed (runtime/bind_to_data.hpp). Code for the scene then uses the same search as the fastest
// of them, unless the code spells out every daughter. Private to runtime/.
#pragma once

#include "runtime/specialisation.hpp"

namespace navjit {

/// The plan as the analysis makes it, or as the environment forces it, without any measurement.
ScenePlan plan_without_measurement(Specialisation& spec, VolumeId volume);

/// Must be called when the navigator of a volume that is bound to data was chosen, or chosen anew.
/// Code for the volume, and for all equal ones, then uses the same search, if it can and does not
/// spell out every daughter.
void search_as_bound(Specialisation& spec, VolumeId volume);

/// The same with the search that an earlier run measured. It holds until something is bound in the
/// volume.
void search_as_listed(Specialisation& spec, const ListedScene& scene);

/// What later runs have to know about a module that was made of these scenes, to make the same text
/// again.
ListedModule to_be_listed(const Specialisation& spec, const std::vector<VolumeId>& scenes);

}  // namespace navjit
