// What the readers of <structure> share.
#pragma once

#include <span>

#include "geometry/gdml/context.hpp"

namespace navjit::gdml {

/// Where the daughters of the volume or assembly being read go.
struct Mother {
  std::vector<Placement>& placements;
  int assembly_depth = 1;        ///< levels of assemblies, counting this one
  const Solid* solid = nullptr;  ///< null in an assembly
};

using DaughterReader = void (*)(FileContext&, const XmlElement&, Mother&);

/// Adds a daughter; fails beyond the limit on placements.
void add_placement(FileContext& file, const XmlElement& element, Mother& mother,
                   Placement placement);

/// physvol
void read_physvol(FileContext& file, const XmlElement& element, Mother& mother);
/// divisionvol: a box cut into boxes along x, y or z
void read_division(FileContext& file, const XmlElement& element, Mother& mother);
/// replicavol: copies along x, y, z or around z
void read_replica(FileContext& file, const XmlElement& element, Mother& mother);

}  // namespace navjit::gdml
