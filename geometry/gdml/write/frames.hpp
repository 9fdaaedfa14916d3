// Frames as GDML has them: positions, and angles about the axes.
#pragma once

#include <string>

#include "navjit/transformation.hpp"

namespace navjit::gdml {

/// The angles of rotation_from_angles() for a rotation without a reflection, rad.
Vec3 angles_of(const double (&rotation)[9]);

/// <position/> and <rotation/>, and <scale/> of a frame that reflects; nothing of what is not
/// there. They are called `name`, which no other frame is: VecGeom asks for that.
std::string placement_text(const std::string& name, const Transformation& frame);

/// Likewise of the second operand of a boolean, which turns the solid and not its frame.
std::string operand_text(const std::string& name, const Transformation& frame);

}  // namespace navjit::gdml
