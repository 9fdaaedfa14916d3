// Which scenes are compiled next. Private to runtime/; docs/decisions.md gives the reasons.
#pragma once

#include <vector>

#include "runtime/schedule.hpp"
#include "runtime/specialisation.hpp"

namespace navjit {

/// Applies what the environment forces scenes to (runtime/overrides.hpp).
void apply_overrides(Specialisation& spec);

/// Scenes that might be compiled now.
struct DueScenes {
  std::vector<Candidate> candidates;
  SpecialiserOptions options;  ///< as they are at this time of the run
  double paid = 0;             ///< times_paid of the best scene that is due; 0 if none is
};
DueScenes due_scenes(Specialisation& spec);

/// The scenes of the next module, as next_module() chooses them; `least` as in that function.
std::vector<VolumeId> choose(const Specialisation& spec, const DueScenes& due, double least);

/// Whether the scene has not been tried yet, or so long ago that trying again may pay.
bool may_be_tried(Specialisation& spec, VolumeId volume);

/// Those scenes of the batch whose plan promises a gain. Notes the result for each of the others.
std::vector<VolumeId> worth_trying(Specialisation& spec, const std::vector<VolumeId>& batch);

}  // namespace navjit
