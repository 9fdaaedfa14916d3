// Converts VecGeom's shapes to navjit's solids.
#pragma once

#include <VecGeom/volumes/UnplacedVolume.h>

#include <optional>
#include <string>

#include "navjit/solids.hpp"

namespace navjit::vecgeom {

/// The solid of a shape whose lengths are in units of `mm` millimetres; nothing if it holds no
/// point, as an intersection of shapes that are apart. Throws GeometryError, which names the
/// shape's class, if there is no kernel for it, or if its dimensions make no solid.
std::optional<Solid> solid_of(const ::vecgeom::VUnplacedVolume& shape, const std::string& name,
                              double mm);

}  // namespace navjit::vecgeom
