// What the tables show: errors and counts of an engine, overall, by scene and by kind of surface.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "analysis/error_bound.hpp"
#include "apps/accuracy/judge.hpp"

namespace navjit::accuracy {

struct Quantiles {
  double median = 0, high = 0, largest = 0;  ///< high: 99.9% are no larger
};
/// Zeros for no values.
Quantiles quantiles(std::vector<float> values);

/// Errors of many steps.
struct Errors {
  std::vector<float> along_mm;    ///< of the length
  std::vector<float> along_ulp;   ///< in last bits of the coordinates' magnitude
  std::vector<float> across_ulp;  ///< distance of the step's end from the surface

  void add(const JudgedStep& step);
  void append(const Errors& other);
};

/// Steps with one thing in common.
struct StepFigures {
  std::uint64_t steps = 0;
  std::uint64_t wrong_volume = 0;
  std::uint64_t wrong_end = 0;
  Errors errors;

  void add(const JudgedStep& step);
  void append(const StepFigures& other);
};

/// A step that is worth looking at, with what it takes to see it again.
struct WorstStep {
  JudgedStep judged;
  Ray ray;
  std::size_t ray_index = 0;
  Vec3 point{0, 0, 0};
  double length = 0;
  std::string claim;  ///< path of the touchable, or the volume's name
};

/// Everything about one engine.
struct EngineFigures {
  std::uint64_t rays = 0;
  std::uint64_t outside = 0;  ///< of the rays: made no step
  std::uint64_t made = 0;     ///< steps
  std::uint64_t equal = 0;    ///< of these, equal to the generic navigator's to the last bit
  std::uint64_t stuck = 0;    ///< rays
  std::uint64_t lost = 0;     ///< rays
  std::uint64_t skipped = 0;  ///< steps too short to judge
  std::uint64_t arguable = 0;
  std::uint64_t bounded = 0;       ///< steps in scenes whose error is bounded (error_bounds)
  std::uint64_t beyond_bound = 0;  ///< of these, off by more than the bound: there must be none
  double largest_part = 0;         ///< of a bound that an error took
  StepFigures all;
  std::map<VolumeId, StepFigures> scenes;              ///< by the volume they were made in
  std::map<kernels::SolidKind, StepFigures> surfaces;  ///< by the solid whose surface ended them
  std::vector<WorstStep> worst_across, worst_along, wrong;  ///< the first few, worst first
  std::vector<WorstStep>
      given_up;  ///< the last steps of rays that are stuck or lost, the first few

  void add(const World& world, const Ray& ray, const MadeRay& made, const JudgedRay& judged);
  /// Counts the steps that are off by more than their scenes promise.
  void hold_against(const std::vector<ErrorBound>& bounds, const JudgedRay& judged);
  /// Adds what another thread found.
  void append(const EngineFigures& other);
};

}  // namespace navjit::accuracy
