// Which volumes are homogenised: those that save the most boundaries for the least change of rays.
#pragma once

#include <map>
#include <set>
#include <span>
#include <vector>

#include "geometry/rays/ray.hpp"
#include "observe/mixtures.hpp"
#include "observe/passages.hpp"

namespace navjit {

/// By mother: the volumes of the daughters that become part of its mixture.
using ChosenMixtures = std::map<VolumeId, std::set<VolumeId>>;

/// How much rays change by a choice, in the unit of the rates.
struct RayChanges {
  double whole = 0;  ///< the mean of what a ray went through before
  double mean = 0;   ///< the mean of the absolute changes
  double error = 0;  ///< one standard deviation of that mean
  double signed_mean = 0, signed_error = 0;
  double of_99 = 0, of_999 = 0, largest = 0;  ///< the most for 99%, 99.9% and all of the rays
};

/// The changes that a choice makes to the rays of the passages.
RayChanges changes_of(const World& world, const Mixtures& mixtures,
                      const std::vector<double>& rates, const Passages& passages,
                      const ChosenMixtures& chosen);

/// Chooses by gain for each error, as long as the mean change of these rays is at most `mean`, in
/// the unit of the rates.
ChosenMixtures choose_mixtures(const World& world, const Mixtures& mixtures,
                               const std::vector<double>& rates, const Passages& passages,
                               double mean);

}  // namespace navjit
