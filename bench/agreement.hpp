// Whether two engines took a ray through the same volumes.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace navjit::bench {

/// One step of a ray.
struct Passed {
  std::string volume;
  double length;  ///< mm
};

/// The steps that get on: shorter ones are the engines' own way of crossing faces that touch, and
/// go to the step before.
std::vector<Passed> without_short_steps(std::span<const Passed> steps, double shortest);

/// Whether both went through the same volumes, with boundaries that are no farther apart than the
/// tolerance, mm. A step of twice the tolerance or less may be left out.
bool agree(std::span<const Passed> a, std::span<const Passed> b, double tolerance);

}  // namespace navjit::bench
