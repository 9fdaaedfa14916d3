// Which scenes are to be compiled next. Private to runtime/; docs/decisions.md has the reasons.
#pragma once

#include <vector>

#include "runtime/specialisation.hpp"

namespace navjit {

/// What the environment forces scenes to (runtime/overrides.hpp).
void apply_overrides(Specialisation& spec);

/// The scenes of the next module; none if nothing is due.
std::vector<VolumeId> choose(Specialisation& spec);

/// Not tried yet, or long enough ago that trying again may pay.
bool may_be_tried(Specialisation& spec, VolumeId volume);

/// Those whose plan promises a gain; notes what becomes of each.
std::vector<VolumeId> worth_trying(Specialisation& spec, const std::vector<VolumeId>& batch);

}  // namespace navjit
