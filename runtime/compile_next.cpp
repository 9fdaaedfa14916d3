#include "runtime/compile_next.hpp"

#include <algorithm>

#include "runtime/bind_to_structure.hpp"
#include "runtime/choose.hpp"
#include "runtime/compile_solids.hpp"
#include "runtime/judge.hpp"
#include "runtime/remembered_modules.hpp"

namespace navjit {
namespace {

/// Scenes or solids are added to a module if they have paid at least this share of what the best
/// candidate of another kind has. With a larger share that candidate has its turn sooner, and there
/// are more modules. A guess.
constexpr double near_enough = 0.5;

}  // namespace

bool compile_next(Specialisation& spec) {
  const DueScenes scenes = due_scenes(spec);
  const double solids = solids_paid(spec);
  const std::optional<DueStructure> structure = due_structure(spec);
  const double structures = structure ? structure->paid : 0;
  if (spec.stopping() || std::max({scenes.paid, solids, structures}) == 0) return false;
  if (solids >= std::max(scenes.paid, structures)) {
    return compile_solids(spec, near_enough * std::max(scenes.paid, structures));
  }
  if (structures >= scenes.paid) return bind_to_structure(spec, *structure);
  const std::vector<VolumeId> batch =
      choose(spec, scenes, near_enough * std::max(solids, structures));
  if (batch.empty()) return false;
  show_candidates(spec);
  make_and_remember(spec, batch);
  return true;
}

}  // namespace navjit
