// What the parts of the translation share: from a geometry of ROOT to a world.
#pragma once

#include <map>
#include <string>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "geometry/model/world.hpp"
#include "geometry/notes.hpp"
#include "geometry/root/objects.hpp"
#include "geometry/solids/boolean_size.hpp"

namespace navjit::root {

constexpr double cm = 10;  ///< the unit of ROOT's lengths, mm

/// A solid, and how large it is as a boolean.
struct MadeSolid {
  Solid solid;
  BooleanSize size{};
};

/// Placements made together: one of a volume, or those of an assembly, which has no solid.
struct MadeVolume {
  bool assembly = false;
  bool empty = false;                   ///< a flat leaf: no point is in it, and it has no id
  VolumeId id = 0;                      ///< of a volume
  std::vector<Placement> placements{};  ///< of an assembly
};

/// Everything of one geometry that is being read.
struct Reading {
  Objects& objects;
  const RootLimits& limits;
  World world{};
  Notes notes{};

  std::unordered_map<Reference, MadeSolid> solids{};
  std::size_t boolean_parts = 0;                  ///< parts of all booleans
  std::size_t corner_pairs = 0;                   ///< of all polygons: their time is in proportion
  std::size_t facets = 0;                         ///< facets and vertices of all tessellated solids
  std::unordered_map<Reference, bool> endless{};  ///< by shape: whether it is infinite
  std::unordered_map<Reference, MadeVolume> volumes{};
  std::unordered_map<Reference, bool> open_volumes{};
  std::size_t placements = 0, name_bytes = 0;
  std::unordered_map<Reference, std::uint32_t> materials{};
  std::map<std::tuple<std::string, double, double>, std::uint32_t> elements{};
};

/// Where something is in what holds it: outer = rotation * local + translation (mm), as ROOT
/// defines it.
struct Frame {
  double translation[3] = {0, 0, 0};
  double rotation[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< local-to-outer, row-major
};
/// Reads a TGeoMatrix; the identity for 0.
Frame read_frame(Reading& reading, Reference matrix);
/// Reads one slice of a divided volume, a TGeoNodeOffset. `shape` is that of the divided volume.
Frame read_slice(Reading& reading, const Object& node, Reference shape);
/// The frame as navigation uses it. Throws GeometryError.
Transformation transformation_of(const Frame& frame);

/// Reads a TGeoShape. `depth`: the number of nested shapes down to this one, itself counted.
const MadeSolid& read_solid(Reading& reading, Reference shape, std::size_t depth = 1);
/// Reads a shape that is given by numbers alone. Fails for any other class.
Solid read_primitive(const Object& shape);
/// Whether such a shape has no thickness along an axis: ROOT allows it, and nothing is ever in it.
bool is_flat(const Object& shape);
/// Reads a TGeoXtru.
MadeSolid read_extruded(Reading& reading, const Object& shape);
/// Reads a TGeoTessellated.
Solid read_tessellated(Reading& reading, const Object& shape);

/// The number, in the world, of a TGeoMedium's material; for 0, of a material without a name.
std::uint32_t read_material(Reading& reading, Reference medium);

/// Reads a TGeoVolume with all below it.
const MadeVolume& read_volume(Reading& reading, Reference volume, int depth = 0);

}  // namespace navjit::root
