// Converts VecGeom's world to a navjit::Detector.
#pragma once

#include <VecGeom/volumes/PlacedVolume.h>

#include <string>
#include <unordered_map>
#include <vector>

#include "adapters/vecgeom/paths.hpp"
#include "navjit/vecgeom.hpp"

namespace navjit::vecgeom {

/// A world that was converted, with the tables that belong to it.
struct ConvertedWorld {
  Detector detector;
  Paths paths;
  std::unordered_map<const ::vecgeom::LogicalVolume*, VolumeId> volumes;  ///< without assemblies
  std::vector<std::string> empty;  ///< volumes that hold no point, and are left out
};

/// Converts every volume below the world; daughters of assemblies become daughters of what holds
/// these. A volume that holds no point is left out with its daughters: no track enters it. Lengths
/// are in units of `mm` millimetres. Throws GeometryError, which names the volume.
ConvertedWorld convert(const ::vecgeom::VPlacedVolume& world, double mm,
                       const MaterialOf& material);

}  // namespace navjit::vecgeom
