// What the readers of <structure> share.
#pragma once

#include <algorithm>
#include <span>

#include "geometry/gdml/solids.hpp"

namespace navjit::gdml {

/// Where the daughters go of the volume or assembly that is being read.
struct Mother {
  std::vector<Placement>& placements;
  int assembly_depth = 1;             ///< levels of assemblies, counting this one
  Assembly* assembly = nullptr;       ///< the one that is being read; null in a volume
  const NamedSolid* solid = nullptr;  ///< null in an assembly
};

using DaughterReader = void (*)(FileContext&, const XmlElement&, Mother&);

/// Adds a volume that has this solid.
VolumeId add_volume(Session& session, LogicalVolume volume, const NamedSolid* solid);
/// A volume for the assembly of this name: a box about its origin, with room around all that it
/// holds. For worlds that are assemblies: parts of detectors are often written like that.
VolumeId box_around(FileContext& file, const XmlElement& element, const std::string& name);
/// Fails if so many more placements exceed the limit.
void check_placements(FileContext& file, const XmlElement& element, std::size_t count);
/// Adds a daughter; fails if there are more placements than the limit.
void add_placement(FileContext& file, const XmlElement& element, Mother& mother,
                   Placement placement);

/// Gives the placements from `first` on, which are the assembly's, the copy numbers that Geant4
/// gives them (G4AssemblyVolume::MakeImprint), whatever the file says: they count from the number
/// of daughters before them, and those of an assembly in it from a hundred times its place.
void number_imprint(const Assembly& assembly, std::span<Placement> daughters, std::size_t first);

/// A volume like `id`, with the same name and daughters, but with another solid, which is given by
/// `size` numbers. Fails beyond the limits.
VolumeId with_solid(FileContext& file, const XmlElement& element, VolumeId id, Solid solid,
                    std::size_t size);
/// About how many numbers give a shape that can be divided.
inline std::size_t size_of(const DivisibleShape& shape) {
  return 4 * shape.planes.size() + static_cast<std::size_t>(std::max(shape.sides, 0));
}

/// One piece of a divided solid and its place: turned by `turn` about z, then moved.
struct Slice {
  DivisibleShape shape;
  double translation[3] = {0, 0, 0};
  double turn = 0;
};
enum class DivisionAxis { x, y, z, rho, phi };
struct Division {
  DivisionAxis axis;
  int number = 0;
  double width = 0, offset = 0;  ///< mm or rad
  bool by_planes = false;        ///< cut between the z planes of a polycone or polyhedra
};
/// The length or angle along an axis that can be divided, mm or rad; nothing if there is none.
std::optional<double> divisible_length(const DivisibleShape& shape, DivisionAxis axis);
Slice slice(const DivisibleShape& shape, const Division& division, int i);

/// The frame that <position> and <rotation> place a daughter in.
Transformation placement_frame(const Frame& frame, const Vector& scale = {1, 1, 1});

/// physvol
void read_physvol(FileContext& file, const XmlElement& element, Mother& mother);
/// divisionvol: a solid cut along one of its axes
void read_division(FileContext& file, const XmlElement& element, Mother& mother);
/// replicavol: copies along x, y or z, outwards from the z axis, or around it
void read_replica(FileContext& file, const XmlElement& element, Mother& mother);
/// paramvol: copies with frames and dimensions of their own
void read_paramvol(FileContext& file, const XmlElement& element, Mother& mother);

}  // namespace navjit::gdml
