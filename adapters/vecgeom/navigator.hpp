// VecGeom's interface for steps, with navjit's answers.
#pragma once

#include <VecGeom/navigation/VNavigator.h>

#include "adapters/vecgeom/asked.hpp"
#include "adapters/vecgeom/before.hpp"
#include "adapters/vecgeom/safety.hpp"

namespace navjit::vecgeom {

/// Serves all volumes of its world. navjit locates the end of a step, without VecGeom's relocation;
/// the states are VecGeom's paths.
class StepNavigator final : public ::vecgeom::VNavigator {
 public:
  using State_t = NavigationState;
  using SOA = ::vecgeom::SOA3D<double>;
  using Pool = ::vecgeom::NavStatePool;

  StepNavigator(const Asked& asked, const Before& before, SafetyEstimator& safety)
      : VNavigator(&safety), asked_(asked), before_(before) {}

  double ComputeStepAndPropagatedState(const Vector& point, const Vector& direction, double limit,
                                       const State_t& in, State_t& out) const override;
  double ComputeStep(const Vector& point, const Vector& direction, double limit, const State_t& in,
                     State_t& out) const override;
  double ComputeStepAndSafety(const Vector& point, const Vector& direction, double limit,
                              State_t& in, bool with_safety, double& safety,
                              bool push_daughter) const override;
  double ComputeStepAndSafetyAndPropagatedState(const Vector& point, const Vector& direction,
                                                double limit, const State_t& in, State_t& out,
                                                bool with_safety, double& safety) const override;

  void ComputeStepsAndPropagatedStates(const SOA& points, const SOA& directions,
                                       const double* limits, const State_t* const* in,
                                       State_t** out, double* lengths) const override;
  void ComputeStepsAndSafetiesAndPropagatedStates(const SOA& points, const SOA& directions,
                                                  const double* limits, const Pool& in, Pool& out,
                                                  double* lengths, const bool* with_safety,
                                                  double* safeties) const override;
  void ComputeStepsAndSafetiesAndPropagatedStates(const SOA& points, const SOA& directions,
                                                  const double* limits, const State_t* const* in,
                                                  State_t** out, double* lengths,
                                                  const bool* with_safety,
                                                  double* safeties) const override;
  void ComputeStepsAndSafeties(const SOA& points, const SOA& directions, const double* limits,
                               const State_t* const* in, double* lengths, const bool* with_safety,
                               double* safeties) const override;

  // In a volume's own coordinates: answered by what the volume had before.
  bool CheckDaughterIntersections(const ::vecgeom::LogicalVolume* volume, const Vector& point,
                                  const Vector& direction, const State_t* in, State_t* out,
                                  double& step,
                                  const ::vecgeom::VPlacedVolume*& hit) const override;
  bool CheckDaughterIntersections(const ::vecgeom::LogicalVolume* volume, const Vector& point,
                                  const Vector& direction, const ::vecgeom::VPlacedVolume* blocked,
                                  double& step,
                                  const ::vecgeom::VPlacedVolume*& hit) const override;

  const char* GetName() const override { return "navjit"; }
  const Before& before() const { return before_; }

 protected:
  void Relocate(const Vector& point, const State_t& in, State_t& out) const override;

 private:
  /// Adds to the path of a step's start the daughter that the step entered, if there is one.
  void push_entered(const State_t& in, const State& from, const Navigator& navigator,
                    const Step& step, State_t& path) const;

  const Asked& asked_;
  const Before& before_;
};

}  // namespace navjit::vecgeom
