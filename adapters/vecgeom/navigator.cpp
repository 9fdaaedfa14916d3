#include "adapters/vecgeom/navigator.hpp"

namespace navjit::vecgeom {
namespace {

/// Writes where a step has led; `out` already has the values of `in`.
void propagate(const Paths& paths, const State& from, const Navigator& navigator, const Step& step,
               const NavigationState& in, NavigationState& out) {
  if (step.next == from) [[unlikely]]
    Paths::set_length(out, in.GetCurrentLevel());
  else
    paths.write(in, from, navigator.levels(), out);
  out.SetBoundaryState(step.boundary);
}

}  // namespace

double StepNavigator::ComputeStepAndPropagatedState(const Vector& point, const Vector& direction,
                                                    double limit, const State_t& in,
                                                    State_t& out) const {
  const State from = asked_.paths.state(in, out);
  Navigator& navigator = asked_.navigators.mine();
  const Step step = asked_.step(navigator, from, point, direction, limit);
  propagate(asked_.paths, from, navigator, step, in, out);
  return asked_.length(step, limit);
}

double StepNavigator::ComputeStepAndSafetyAndPropagatedState(const Vector& point,
                                                             const Vector& direction, double limit,
                                                             const State_t& in, State_t& out,
                                                             bool with_safety,
                                                             double& safety) const {
  const State from = asked_.paths.state(in, out);
  Navigator& navigator = asked_.navigators.mine();
  safety = with_safety ? asked_.safety(navigator, from, point) : 0;
  const Step step = asked_.step(navigator, from, point, direction, limit);
  propagate(asked_.paths, from, navigator, step, in, out);
  return asked_.length(step, limit);
}

double StepNavigator::ComputeStep(const Vector& point, const Vector& direction, double limit,
                                  const State_t& in, State_t& out) const {
  const State from = asked_.paths.state(in, out);
  Navigator& navigator = asked_.navigators.mine();
  const Step step = asked_.step(navigator, from, point, direction, limit);
  Paths::set_length(out, in.GetCurrentLevel());
  out.SetBoundaryState(step.boundary);
  push_entered(in, from, navigator, step, out);
  return asked_.length(step, limit);
}

double StepNavigator::ComputeStepAndSafety(const Vector& point, const Vector& direction,
                                           double limit, State_t& in, bool with_safety,
                                           double& safety, bool push_daughter) const {
  const State from = asked_.paths.state(in);
  Navigator& navigator = asked_.navigators.mine();
  if (with_safety) safety = asked_.safety(navigator, from, point);
  const Step step = asked_.step(navigator, from, point, direction, limit);
  if (push_daughter) push_entered(in, from, navigator, step, in);
  return asked_.length(step, limit);
}

void StepNavigator::push_entered(const State_t& in, const State& from, const Navigator& navigator,
                                 const Step& step, State_t& path) const {
  if (step.next == from) return;
  const int daughter = asked_.paths.entered(in, from, navigator.levels());
  if (daughter >= 0)
    asked_.paths.push_daughter(path, from.volume(), static_cast<std::uint32_t>(daughter));
}

void StepNavigator::ComputeStepsAndPropagatedStates(const SOA& points, const SOA& directions,
                                                    const double* limits, const State_t* const* in,
                                                    State_t** out, double* lengths) const {
  for (std::size_t i = 0; i < points.size(); ++i) {
    lengths[i] =
        ComputeStepAndPropagatedState(points[i], directions[i], limits[i], *in[i], *out[i]);
  }
}

void StepNavigator::ComputeStepsAndSafetiesAndPropagatedStates(
    const SOA& points, const SOA& directions, const double* limits, const Pool& in, Pool& out,
    double* lengths, const bool* with_safety, double* safeties) const {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int n = static_cast<int>(i);
    lengths[i] = ComputeStepAndSafetyAndPropagatedState(points[i], directions[i], limits[i], *in[n],
                                                        *out[n], with_safety[i], safeties[i]);
  }
}

void StepNavigator::ComputeStepsAndSafetiesAndPropagatedStates(
    const SOA& points, const SOA& directions, const double* limits, const State_t* const* in,
    State_t** out, double* lengths, const bool* with_safety, double* safeties) const {
  for (std::size_t i = 0; i < points.size(); ++i) {
    lengths[i] = ComputeStepAndSafetyAndPropagatedState(points[i], directions[i], limits[i], *in[i],
                                                        *out[i], with_safety[i], safeties[i]);
  }
}

void StepNavigator::ComputeStepsAndSafeties(const SOA& points, const SOA& directions,
                                            const double* limits, const State_t* const* in,
                                            double* lengths, const bool* with_safety,
                                            double* safeties) const {
  Navigator& navigator = asked_.navigators.mine();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const State from = asked_.paths.state(*in[i]);
    safeties[i] = with_safety[i] ? asked_.safety(navigator, from, points[i]) : 0;
    lengths[i] =
        asked_.length(asked_.step(navigator, from, points[i], directions[i], limits[i]), limits[i]);
  }
}

bool StepNavigator::CheckDaughterIntersections(const ::vecgeom::LogicalVolume* volume,
                                               const Vector& point, const Vector& direction,
                                               const State_t* in, State_t* out, double& step,
                                               const ::vecgeom::VPlacedVolume*& hit) const {
  return before_.navigator(*volume, this)
      .CheckDaughterIntersections(volume, point, direction, in, out, step, hit);
}

bool StepNavigator::CheckDaughterIntersections(const ::vecgeom::LogicalVolume* volume,
                                               const Vector& point, const Vector& direction,
                                               const ::vecgeom::VPlacedVolume* blocked,
                                               double& step,
                                               const ::vecgeom::VPlacedVolume*& hit) const {
  return before_.navigator(*volume, this)
      .CheckDaughterIntersections(volume, point, direction, blocked, step, hit);
}

void StepNavigator::Relocate(const Vector& point, const State_t& in, State_t& out) const {
  // Only VecGeom's helpers call this, with a point beyond the boundary: it needs no direction.
  Navigator& navigator = asked_.navigators.mine();
  const State from = asked_.paths.state(in, out);
  const Vec3 there = navigator.to_global(from, asked_.point(point));
  const State next = navigator.relocate(from, there, {0, 0, 1});
  if (next == from)
    Paths::set_length(out, in.GetCurrentLevel());
  else
    asked_.paths.write(in, from, navigator.levels(), out);
}

}  // namespace navjit::vecgeom
