// What is lost, and what is won, by observing less: radiation lengths, steps and time along rays.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "navjit/observation.hpp"
#include "runtime/transport.hpp"

namespace navjit::accuracy {

/// Of one observation, beside every boundary of the same rays.
struct ObservedFigures {
  std::string observe;
  double bound = 0;  ///< radiation lengths: what it promises of any ray
  double steps_per_ray = 0;
  double ns_per_ray = 0;       ///< generic navigators
  double data_ns_per_ray = 0;  ///< all scenes bound to data
  /// By how much the radiation lengths along a ray differ: the mean, what one ray in a thousand is
  /// beyond, the largest.
  double mean = 0, most_of_1000 = 0, largest = 0;
  double largest_path = 0;  ///< mm: the most that the path in one material differs along a ray
};

/// The first is `all`.
std::vector<ObservedFigures> compare_observations(const Detector& detector,
                                                  const std::vector<Observation>& observations,
                                                  const std::vector<Ray>& rays, int repetitions);

void print(const std::vector<ObservedFigures>& figures);
nlohmann::ordered_json to_json(const std::vector<ObservedFigures>& figures);
/// Whether one is beyond what it promises, by more than the rounding of sums.
bool any_beyond(const std::vector<ObservedFigures>& figures);

}  // namespace navjit::accuracy
