// The composed solids of a detector, and the scenes that hold them. Private to runtime/.
#pragma once

#include <vector>

#include "analysis/facts.hpp"
#include "geometry/navigation/geometry.hpp"

namespace navjit {

/// A solid that is composed of several. Equal solids of the detector are one ComposedSolid.
struct ComposedSolid {
  kernels::AnySolid<double> solid{};
  Extent extent{};
  std::vector<const void*> shapes{};  ///< the shapes of all equal solids
  struct In {
    VolumeId volume;
    double share;  ///< of the time of a step in the scene: a guess
  };
  std::vector<In> scenes{};
  double compile_ms = 0;    ///< expected
  bool in_library = false;  ///< The library has code for it already.
  bool tried = false;       ///< compiled, or decided against
};

/// All composed solids for which code may be made, in volumes that are in the detector's tree.
std::vector<ComposedSolid> find_composed_solids(const Geometry& geometry, const WorldFacts& facts);

}  // namespace navjit
