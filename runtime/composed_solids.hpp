// The solids of a detector that are made of several, and the scenes that hold them. Private to
// runtime/.
#pragma once

#include <vector>

#include "analysis/facts.hpp"
#include "geometry/navigation/geometry.hpp"

namespace navjit {

/// Equal solids count as one.
struct ComposedSolid {
  kernels::AnySolid<double> solid{};
  Extent extent{};
  std::vector<const void*> shapes{};  ///< all that are equal
  struct In {
    VolumeId volume;
    double share;  ///< of what a step in the scene takes: a guess
  };
  std::vector<In> scenes{};
  double compile_ms = 0;    ///< expected
  bool in_library = false;  ///< The library has code for it already.
  bool tried = false;       ///< compiled, or not to be
};

/// Those that code may be made for, of all volumes that are in the detector.
std::vector<ComposedSolid> find_composed_solids(const Geometry& geometry, const WorldFacts& facts);

}  // namespace navjit
