#include "adapters/vecgeom/safety.hpp"

namespace navjit::vecgeom {

using ::vecgeom::SOA3D;
using ::vecgeom::VPlacedVolume;

void SafetyEstimator::ComputeVectorSafety(const SOA3D<double>& points,
                                          ::vecgeom::NavStatePool& states, double* safeties) const {
  for (std::size_t i = 0; i < points.size(); ++i)
    safeties[i] = ComputeSafety(points[i], *states[static_cast<int>(i)]);
}

void SafetyEstimator::ComputeVectorSafety(const SOA3D<double>& points,
                                          ::vecgeom::NavStatePool& states, SOA3D<double>&,
                                          double* safeties) const {
  ComputeVectorSafety(points, states, safeties);
}

double SafetyEstimator::ComputeSafetyForLocalPoint(const Vector& point,
                                                   const VPlacedVolume* volume) const {
  return before_.safety(*volume->GetLogicalVolume(), this)
      .ComputeSafetyForLocalPoint(point, volume);
}

SafetyEstimator::Real_v SafetyEstimator::ComputeSafetyForLocalPoint(
    const ::vecgeom::Vector3D<Real_v>& point, const VPlacedVolume* volume, Bool_v mask) const {
  return before_.safety(*volume->GetLogicalVolume(), this)
      .ComputeSafetyForLocalPoint(point, volume, mask);
}

double SafetyEstimator::ComputeSafetyToDaughtersForLocalPoint(
    const Vector& point, const ::vecgeom::LogicalVolume* volume) const {
  return before_.safety(*volume, this).ComputeSafetyToDaughtersForLocalPoint(point, volume);
}

void SafetyEstimator::ComputeSafetyForLocalPoints(const SOA3D<double>& points,
                                                  const VPlacedVolume* volume,
                                                  double* safeties) const {
  const ::vecgeom::VSafetyEstimator& had = before_.safety(*volume->GetLogicalVolume(), this);
  for (std::size_t i = 0; i < points.size(); ++i)
    safeties[i] = had.ComputeSafetyForLocalPoint(points[i], volume);
}

}  // namespace navjit::vecgeom
