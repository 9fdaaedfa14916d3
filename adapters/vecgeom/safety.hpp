// VecGeom's interface for safeties, with navjit's answers.
#pragma once

#include "adapters/vecgeom/asked.hpp"
#include "adapters/vecgeom/before.hpp"

namespace navjit::vecgeom {

/// Questions with a state are answered by navjit; questions in a volume's own coordinates, without
/// a state, are answered by what the volume had before.
class SafetyEstimator final : public ::vecgeom::VSafetyEstimator {
 public:
  SafetyEstimator(const Asked& asked, const Before& before) : asked_(asked), before_(before) {}

  double ComputeSafety(const Vector& point, const NavigationState& state) const override {
    return asked_.safety(asked_.navigators.mine(), asked_.paths.state(state), point);
  }
  void ComputeVectorSafety(const ::vecgeom::SOA3D<double>& points, ::vecgeom::NavStatePool& states,
                           double* safeties) const override;
  void ComputeVectorSafety(const ::vecgeom::SOA3D<double>& points, ::vecgeom::NavStatePool& states,
                           ::vecgeom::SOA3D<double>& workspace, double* safeties) const override;

  double ComputeSafetyForLocalPoint(const Vector& point,
                                    const ::vecgeom::VPlacedVolume* volume) const override;
  Real_v ComputeSafetyForLocalPoint(const ::vecgeom::Vector3D<Real_v>& point,
                                    const ::vecgeom::VPlacedVolume* volume,
                                    Bool_v mask) const override;
  double ComputeSafetyToDaughtersForLocalPoint(
      const Vector& point, const ::vecgeom::LogicalVolume* volume) const override;

  const char* GetName() const override { return "navjit"; }
  const Before& before() const { return before_; }

 private:
  void ComputeSafetyForLocalPoints(const ::vecgeom::SOA3D<double>& points,
                                   const ::vecgeom::VPlacedVolume* volume,
                                   double* safeties) const override;

  const Asked& asked_;
  const Before& before_;
};

}  // namespace navjit::vecgeom
