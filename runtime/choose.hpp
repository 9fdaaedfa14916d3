// Which scenes are to be compiled next. Private to runtime/; docs/decisions.md has the reasons.
#pragma once

#include <vector>

#include "runtime/schedule.hpp"
#include "runtime/specialisation.hpp"

namespace navjit {

/// What the environment forces scenes to (runtime/overrides.hpp).
void apply_overrides(Specialisation& spec);

/// Scenes that might be compiled now.
struct DueScenes {
  std::vector<Candidate> candidates;
  SpecialiserOptions options;  ///< as they are at this time of the run
  double paid = 0;             ///< times_paid of the best that is due; 0 if none is
};
DueScenes due_scenes(Specialisation& spec);

/// The scenes of the next module, as next_module() chooses them; `least` as there.
std::vector<VolumeId> choose(const Specialisation& spec, const DueScenes& due, double least);

/// Not tried yet, or long enough ago that trying again may pay.
bool may_be_tried(Specialisation& spec, VolumeId volume);

/// Those whose plan promises a gain; notes what becomes of each.
std::vector<VolumeId> worth_trying(Specialisation& spec, const std::vector<VolumeId>& batch);

}  // namespace navjit
