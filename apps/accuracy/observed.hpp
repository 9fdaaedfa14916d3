// What is lost, and what is won, by observing less: what rays go through, steps and time.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/accuracy/peer.hpp"
#include "navjit/observation.hpp"
#include "runtime/transport.hpp"

namespace navjit::accuracy {

/// Rays whose angle with the z axis has a cosine from low to high.
struct DirectionFigures {
  double low = 0, high = 0;
  std::size_t rays = 0;
  double whole = 0;                               ///< radiation lengths of such a ray, mean
  double mean = 0, most_of_100 = 0, largest = 0;  ///< by how much it changes
};

/// Path of a ray in one material, mm: means over rays.
struct MaterialFigures {
  std::string material;
  double before = 0, after = 0;
  double change = 0;  ///< mean of the absolute value
};

/// Where rays come into volumes that are observed by themselves.
struct EntryFigures {
  std::size_t before = 0, after = 0;  ///< how often
  std::size_t rays_that_differ = 0;   ///< they enter others, or in another order
  double largest = 0;                 ///< how far apart an entry of the others is, mm
};

/// Of one observation, beside every boundary of the same rays.
struct ObservedFigures {
  std::string observe;
  double bound = 0;      ///< what it promises of any ray: radiation lengths
  bool promises = true;  ///< whether the bound is in radiation lengths
  double steps_per_ray = 0;
  double ns_per_ray = 0;       ///< generic navigators
  double data_ns_per_ray = 0;  ///< all scenes bound to data
  double whole = 0;            ///< radiation lengths of a ray in the original, mean
  /// By how much the radiation lengths along a ray differ: the mean, what one ray in a thousand is
  /// beyond, the largest.
  double mean = 0, most_of_1000 = 0, largest = 0;
  double largest_path = 0;  ///< mm: the most that the path in one material differs along a ray
  std::vector<DirectionFigures> directions;  ///< ten of equal solid angles, from -z to +z
  std::vector<MaterialFigures> materials;    ///< those that any ray passes
  EntryFigures entries;
  double vecgeom_ns_per_ray = 0;  ///< of VecGeom reading the written detector; 0: not measured
  std::string vecgeom_failure;    ///< why there is none; empty: it was not asked
};

/// The first is `all`. `vecgeom`: how to measure VecGeom; its detector is not looked at.
/// `prepared` is called once all observations are made.
std::vector<ObservedFigures> compare_observations(const Detector& detector,
                                                  const std::vector<Observation>& observations,
                                                  const std::vector<Ray>& rays, int repetitions,
                                                  const std::optional<VecGeom::Options>& vecgeom,
                                                  const std::function<void()>& prepared = {});

/// Whether one is beyond what it promises, by more than the rounding of sums.
bool any_beyond(const std::vector<ObservedFigures>& figures);

}  // namespace navjit::accuracy
