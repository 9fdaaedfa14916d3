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

/// Merges steps no longer than `shortest` with the step before: they are an engine's own way of
/// crossing faces that touch.
std::vector<Passed> without_short_steps(std::span<const Passed> steps, double shortest);

/// Whether both went through the same volumes, with boundaries that are no farther apart than the
/// tolerance, mm. A step of at most twice the tolerance may be missing in one of them.
bool agree(std::span<const Passed> a, std::span<const Passed> b, double tolerance);

}  // namespace navjit::bench
