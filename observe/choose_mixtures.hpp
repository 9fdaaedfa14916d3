// Which volumes are homogenised: most boundaries for least change of what rays go through.
#pragma once

#include <map>
#include <set>
#include <span>
#include <vector>

#include "geometry/rays/ray.hpp"
#include "observe/mixtures.hpp"
#include "observe/passages.hpp"

namespace navjit {

/// By mother: the volumes of the daughters that become part of it.
using ChosenMixtures = std::map<VolumeId, std::set<VolumeId>>;

/// By how much what rays go through changes, in the unit of the rates.
struct RayChanges {
  double whole = 0;  ///< mean of what a ray goes through as it was
  double mean = 0;   ///< of the absolute values of changes
  double error = 0;  ///< of that mean: one standard deviation
  double signed_mean = 0, signed_error = 0;
  double of_99 = 0, of_999 = 0, largest = 0;  ///< 99% of rays, 99.9%, and all change by no more
};

/// The changes that a choice makes on the rays of the passages.
RayChanges changes_of(const World& world, const Mixtures& mixtures,
                      const std::vector<double>& rates, const Passages& passages,
                      const ChosenMixtures& chosen);

/// Chooses by gain per error as long as the mean change on these rays is at most `mean`, in the
/// unit of the rates.
ChosenMixtures choose_mixtures(const World& world, const Mixtures& mixtures,
                               const std::vector<double>& rates, const Passages& passages,
                               double mean);

}  // namespace navjit
