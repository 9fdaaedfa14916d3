#include "adapters/vecgeom/before.hpp"

#include "adapters/vecgeom/navigator.hpp"

#include <VecGeom/navigation/NewSimpleNavigator.h>
#include <VecGeom/navigation/SimpleSafetyEstimator.h>

namespace navjit::vecgeom {

Before::Had Before::had(const ::vecgeom::LogicalVolume& volume) {
  Had had{volume.GetNavigator(), volume.GetSafetyEstimator()};
  if (const auto* other = dynamic_cast<const StepNavigator*>(had.navigator))
    had.navigator = &other->before().navigator(volume, other);
  if (const auto* other = dynamic_cast<const SafetyEstimator*>(had.safety))
    had.safety = &other->before().safety(volume, other);
  return had;
}

const ::vecgeom::VNavigator& Before::navigator(const ::vecgeom::LogicalVolume& volume,
                                               const ::vecgeom::VNavigator* not_this) const {
  const auto found = all.find(&volume);
  const auto* one = found == all.end() ? volume.GetNavigator() : found->second.navigator;
  if (one == nullptr || one == not_this) return *::vecgeom::NewSimpleNavigator<>::Instance();
  return *one;
}

const ::vecgeom::VSafetyEstimator& Before::safety(
    const ::vecgeom::LogicalVolume& volume, const ::vecgeom::VSafetyEstimator* not_this) const {
  const auto found = all.find(&volume);
  const auto* one = found == all.end() ? volume.GetSafetyEstimator() : found->second.safety;
  if (one == nullptr || one == not_this) return *::vecgeom::SimpleSafetyEstimator::Instance();
  return *one;
}

}  // namespace navjit::vecgeom
