// VecGeom's world as a navjit::Detector.
#pragma once

#include <VecGeom/volumes/PlacedVolume.h>

#include <string>
#include <unordered_map>
#include <vector>

#include "adapters/vecgeom/paths.hpp"
#include "navjit/vecgeom.hpp"

namespace navjit::vecgeom {

/// What is known of a world that was taken over.
struct ConvertedWorld {
  Detector detector;
  Paths paths;
  std::unordered_map<const ::vecgeom::LogicalVolume*, VolumeId> volumes;  ///< without assemblies
  std::vector<std::string> empty;  ///< volumes that hold no point, and are left out
};

/// Every volume below the world; daughters of assemblies become daughters of what the assemblies
/// are placed in. What holds no point is left out, with its daughters: it is never entered. Lengths
/// are in units of `mm` millimetres. Throws GeometryError, naming the volume.
ConvertedWorld convert(const ::vecgeom::VPlacedVolume& world, double mm,
                       const MaterialOf& material);

}  // namespace navjit::vecgeom
