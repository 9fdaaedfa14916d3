// One checksum of everything in a detector that navigation depends on.
#pragma once

#include <string>

#include "geometry/navigation/geometry.hpp"

namespace navjit {

/// SHA-256, in hexadecimal, of the volumes' names, solids, daughters and their frames, the world
/// volume and the tolerance. Two detectors have the same fingerprint if every step in them is the
/// same and volumes have the same numbers. Materials and names of placements do not count.
std::string geometry_fingerprint(const Geometry& geometry);

}  // namespace navjit
