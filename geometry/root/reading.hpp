// What the parts of the translation share: a geometry of ROOT's on one side, a world on the other.
#pragma once

#include <map>
#include <string>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "geometry/gdml/notes.hpp"
#include "geometry/model/world.hpp"
#include "geometry/root/objects.hpp"
#include "geometry/solids/boolean_size.hpp"

namespace navjit::root {

constexpr double cm = 10;  ///< of ROOT's lengths, mm

/// A solid, and what it took to make it.
struct MadeSolid {
  Solid solid;
  BooleanSize size{};
};

/// Placements that go together: those of a volume, or of an assembly, which has no solid.
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
  gdml::Notes notes{};

  std::unordered_map<Reference, MadeSolid> solids{};
  std::size_t boolean_parts = 0;  ///< of all booleans
  std::size_t corner_pairs = 0;   ///< of all polygons: the time to look at them goes with it
  std::size_t facets = 0;         ///< of all tessellated solids, and their vertices
  std::unordered_map<Reference, bool> endless{};  ///< shapes: whether they have no end
  std::unordered_map<Reference, MadeVolume> volumes{};
  std::unordered_map<Reference, bool> open_volumes{};
  std::size_t placements = 0, name_bytes = 0;
  std::unordered_map<Reference, std::uint32_t> materials{};
  std::map<std::tuple<std::string, double, double>, std::uint32_t> elements{};
};

/// Where something is in what holds it: outer = rotation * local + translation (mm), as ROOT has
/// it.
struct Frame {
  double translation[3] = {0, 0, 0};
  double rotation[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< local-to-outer, row-major
};
/// A TGeoMatrix; the identity for 0.
Frame read_frame(Reading& reading, Reference matrix);
/// One slice of a divided volume: a TGeoNodeOffset. `shape`: the divided volume's.
Frame read_slice(Reading& reading, const Object& node, Reference shape);
/// The frame as navigation has it. Throws GeometryError.
Transformation transformation_of(const Frame& frame);

/// A TGeoShape. `depth`: of those that it is within, itself counted.
const MadeSolid& read_solid(Reading& reading, Reference shape, std::size_t depth = 1);
/// One that is made of numbers alone. Fails for one of another class.
Solid read_primitive(const Object& shape);
/// Whether one of these has no thickness along an axis: ROOT takes it, and nothing is ever in it.
bool is_flat(const Object& shape);
/// A TGeoXtru.
MadeSolid read_extruded(Reading& reading, const Object& shape);
/// A TGeoTessellated.
Solid read_tessellated(Reading& reading, const Object& shape);

/// The number of a TGeoMedium's material in the world; for 0, of one that has no name.
std::uint32_t read_material(Reading& reading, Reference medium);

/// A TGeoVolume with all below it.
const MadeVolume& read_volume(Reading& reading, Reference volume, int depth = 0);

}  // namespace navjit::root
