// Frames as GDML writes them: positions, and angles about the axes.
#pragma once

#include <string>

#include "navjit/transformation.hpp"

namespace navjit::gdml {

/// The angles from which rotation_from_angles() makes a rotation without reflection, rad.
Vec3 angles_of(const double (&rotation)[9]);

/// <position/> and <rotation/>, and <scale/> of a frame that reflects; what a frame lacks is left
/// out. They are called `name`, which no other frame may have: VecGeom demands that.
std::string placement_text(const std::string& name, const Transformation& frame);

/// Whether a frame mirrors what is in it.
bool mirrors(const Transformation& frame);
/// A frame that mirrors, without its reflection of z, which comes last.
Transformation without_mirror(const Transformation& frame);

/// The same for the second operand of a boolean: there GDML turns the solid and not its frame, and
/// knows no reflection. The frame must not mirror.
std::string operand_text(const std::string& name, const Transformation& frame);

}  // namespace navjit::gdml
