// Replaces volumes that change rays little in the mean by mixtures.
#pragma once

#include <memory>

#include "observe/choose_mixtures.hpp"

namespace navjit {

struct Homogenised {
  /// The tree as it was, finished. Mothers that became mixtures have new materials, and have lost
  /// the thresholds that were derived from the old ones.
  World world;
  ChosenMixtures chosen;  ///< for dissolve()
  std::vector<ObservationReport::Mixture> mixtures;
  ObservationReport::Measured measured;
  double bound = 0;  ///< by how much any ray may change, in the budget's unit
};

/// Chooses by the rays of one sample, and judges by the rays of others: less is mixed until the
/// mean change of fresh rays, with three times its error, is within the budget. Equal arguments
/// give equal results. Throws GeometryError if the observation names a volume that does not exist,
/// or if the rays' origin is outside the world.
Homogenised homogenise(const std::shared_ptr<const World>& world, const Observation& observation);

}  // namespace navjit
