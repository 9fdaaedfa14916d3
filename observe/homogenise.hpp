// A detector with mixtures in the place of what changes rays little in the mean.
#pragma once

#include <memory>

#include "observe/choose_mixtures.hpp"

namespace navjit {

struct Homogenised {
  /// The tree as it was. Mothers of mixtures are of new materials, and have lost the thresholds
  /// that were derived from the old ones. Finished.
  World world;
  ChosenMixtures chosen;  ///< for dissolve()
  std::vector<ObservationReport::Mixture> mixtures;
  ObservationReport::Measured measured;
  double bound = 0;  ///< by how much any ray may change, in the unit of the budget
};

/// Rays of one sample choose, and rays of others judge: less is mixed until the mean change of
/// fresh rays, with three times its error, is within the budget. The same for the same arguments.
/// Throws GeometryError if the observation names a volume that is not there, or if rays are from an
/// origin outside the world.
Homogenised homogenise(const std::shared_ptr<const World>& world, const Observation& observation);

}  // namespace navjit
