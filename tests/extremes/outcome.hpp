// How engines do in an extreme.
#pragma once

#include <memory>
#include <string>

#include "apps/accuracy/figures.hpp"
#include "tests/extremes/cases.hpp"

namespace navjit::extremes {

struct Outcome {
  accuracy::EngineFigures figures;
  std::uint64_t refused = 0;    ///< rays that the engine said no to
  std::uint64_t differing = 0;  ///< steps that are not the generic navigator's to the last bit
  std::vector<std::string> differences{};  ///< the first few, in words
  std::string failure;                     ///< of the engine as a whole, in words
};

struct Outcomes {
  Outcome generic, specialised;
  std::uint64_t specialised_scenes = 0;  ///< scenes in which a specialised navigator made steps
};

/// The outcome of navjit's navigators. Throws what the reader throws.
Outcomes run_case(const Case& extreme);

/// The outcome of VecGeom, in processes of their own; each may take `seconds`.
Outcome run_vecgeom(const Case& extreme, const std::string& program, double seconds);

}  // namespace navjit::extremes
