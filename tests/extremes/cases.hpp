// The extremes: detectors and rays at the limits of what numbers can resolve.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "geometry/model/world.hpp"
#include "runtime/transport.hpp"

namespace navjit::extremes {

struct Case {
  std::string name;              ///< what is extreme, as the table has it
  std::string gdml;              ///< the detector
  std::string gdml_for_vecgeom;  ///< what VecGeom can read of it; empty: all of it
  std::function<std::vector<Ray>(const World&)> rays;  ///< directions are not normalised
  bool refused = false;  ///< every ray has a number that is not finite, and has to be refused
  /// Whether VecGeom is given it: not what it is not made for (overlaps), or cannot read at all.
  bool for_vecgeom = true;
};

/// `full`: with as many rays and boundaries as the table in the documents has; otherwise with as
/// many as a test has time for.
std::vector<Case> all_cases(bool full);

}  // namespace navjit::extremes
