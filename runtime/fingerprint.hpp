// One number for all of a detector that navigation depends on.
#pragma once

#include <string>

#include "geometry/navigation/geometry.hpp"

namespace navjit {

/// SHA-256, in hexadecimal, of the volumes' names, solids, daughters and their frames, the world
/// volume and the tolerance. Equal for detectors in which every step is the same and volumes have
/// the same numbers. Materials and names of placements do not count.
std::string geometry_fingerprint(const Geometry& geometry);

}  // namespace navjit
