// What a specialised navigator for one scene shall be: every decision, as data. Printed by
// `navjit inspect`, turned into text by codegen, which decides nothing itself.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/navigation/geometry.hpp"

namespace navjit {

/// What is known about the frames of a volume over all its touchables.
struct FrameFacts {
  /// True: no touchable of this volume is rotated in the world.
  bool never_rotated = false;
  /// The rotation that all touchables share, where there is just one and it is not the identity.
  std::optional<std::array<double, 9>> only_rotation;
  unsigned rotation = 0;  ///< number of only_rotation in the world, from 1; 0 for none
  /// The frame itself, where the volume has a single touchable.
  std::optional<std::array<double, 3>> only_translation;
};

/// A regular partition of the scene into cells along one to three axes, each with the daughters
/// that reach into it. Stacks, grids, lattices and rings all become few candidates a cell.
struct Grid {
  std::array<int, 3> count{1, 1, 1};   ///< 1 on axes that are not split
  std::array<double, 3> origin{};      ///< lower edge, mm
  std::array<double, 3> width{};       ///< of a cell, mm
  std::vector<std::uint32_t> first;    ///< by cell, and one more: start in `members`
  std::vector<std::uint32_t> members;  ///< daughter indices, ascending within a cell

  std::size_t size() const { return first.empty() ? 0 : first.size() - 1; }
};

/// Daughters that follow one another along an axis: positions count along it.
struct Slabs {
  int axis = 0;
  std::vector<std::uint32_t> members;  ///< daughter indices, by position
  std::vector<double> low, high;       ///< by position, with the margin, mm
  double origin = 0, width = 0;        ///< of the cells, mm
  /// From a face of the margin to where a track that left there meets the slab no more, mm; 0
  /// where not all are boxes along the axes.
  double skin = 0;
  /// By cell: the first position that a ray ascending from there may meet, and for one that
  /// descends.
  std::vector<std::uint32_t> ascending, descending;
};

/// Slabs within slabs: daughters that planes between them separate into slabs along an axis, and
/// what is in each of these into slabs along another, until one daughter is left, or a group that
/// no such plane divides. Layers of rows of tiles, planes of bars, lattices of straws.
struct Layers {
  enum class Kind : std::uint8_t { slabs, daughter, group };
  struct Part {
    Kind kind = Kind::daughter;
    std::uint32_t number = 0;  ///< among `slabs`, the daughters, or `groups`
  };
  struct Division {
    Slabs slabs;              ///< without members
    std::vector<Part> parts;  ///< by position
  };
  std::vector<Division> divisions;                 ///< the first one is of all daughters
  std::vector<std::vector<std::uint32_t>> groups;  ///< daughter indices, ascending
  double mean_group = 0;  ///< daughters that are asked together, by daughter

  bool found() const { return !divisions.empty(); }
};

/// Daughters in layers about an axis or a centre, ascending in both radii.
struct Nest {
  int axis = 2;                        ///< 3: about the mother's origin
  std::vector<std::uint32_t> members;  ///< daughter indices, by position
  std::vector<double> near2, far2;     ///< by position, squared radii with the margin, mm^2
  /// Whether rays in the mother come beyond the ends of all layers, and these with the margin, mm.
  bool ends = false;
  double low = 0, high = 0;
  std::vector<std::uint32_t> others;  ///< daughters that are no layers
};

/// Daughters at steps of azimuth about an axis, and the sectors that they are in.
struct Ring {
  double near = 0, far = 0, low = 0, high = 0;  ///< with the margin, mm
  /// Whether a ray in the mother may be nearer to the axis, farther from it, or beyond the ends.
  bool hole = false, outside = false, ends = false;
  bool segments = false;  ///< all are cut to a segment of azimuth about the ring's own axis
  int steps = 0;          ///< in a full turn, a sector each
  int present = 0;        ///< daughters
  double reach = 0;       ///< how near to an edge the sector beyond it counts, too, mm
  double lean = 0;        ///< edges are tangents of a circle about the axis; 0: radii, mm
  std::vector<std::array<double, 2>> edges;  ///< unit vectors along lower edges; the first again
  std::vector<std::uint32_t> at_angle;  ///< by cell of kernels::square_angle: sector of its start
  std::vector<std::uint32_t> first;     ///< by sector, and one more: start in `members`
  std::vector<std::uint32_t> members;   ///< daughter indices, ascending within a sector
};

struct Rings {
  int axis = 2;
  std::vector<Ring> rings;
  std::vector<std::uint32_t> others;  ///< daughters in no ring
};

/// Parallel wires in a row, by their places across it: u along the row, n along its normal.
struct WireRow {
  double at = 0;                       ///< n of the row's middle, mm
  double half_u = 0, half_n = 0;       ///< of a rectangle that holds any of the wires about its u
                                       ///< and the row's n, with the margin, mm
  double radius = 0;                   ///< and of a circle
  std::vector<std::uint32_t> members;  ///< daughter indices, by position along the row
  std::vector<double> u;               ///< of the wires' middles, by position, mm
  double origin = 0, width = 0;        ///< of cells along the row, mm
  std::vector<std::uint32_t> first;    ///< by cell, and one more: the first position in it
};

/// Wires of one direction.
struct WireBundle {
  std::array<double, 3> across{}, normal{}, along{};  ///< unit vectors of u, n, and of the wires
  std::vector<WireRow> rows;                          ///< ascending in n
  bool round = false;                                 ///< all wires are tubes
  /// Whether rays in the mother come beyond the ends of all wires, and these with the margin, mm.
  bool ends = false;
  double low = 0, high = 0;
};

struct Wires {
  std::vector<WireBundle> bundles;
  std::vector<std::uint32_t> others;  ///< daughters that are in no row
  /// Whether distances across bound what each wire's safety_to_in gives.
  bool safety_known = false;
};

enum class Candidates : std::uint8_t {
  none,    ///< no daughters
  all,     ///< every daughter, spelled out
  lanes,   ///< every daughter, all of them boxes along the axes, four at once
  slabs,   ///< those next along an axis
  nest,    ///< those next in radius
  rings,   ///< those of the sectors that the ray passes
  wires,   ///< those next across, in rows; bound to data only
  grid,    ///< those of the cells that the ray passes
  boxes,   ///< of those, the ones whose boxes it passes
  scan,    ///< those whose boxes it meets, all looked at first
  groups,  ///< the same, of boxes around several of them first; bound to data only
  tree,    ///< by the generic navigator's hierarchy of boxes; bound to data only
  layers,  ///< slabs within slabs; bound to data only
};

/// Daughters that Candidates::scan may look at.
constexpr std::size_t most_scanned = 64;
constexpr bool may_be_scanned(std::size_t daughters) {
  return daughters > 1 && daughters <= most_scanned;
}
/// And Candidates::groups. A guess.
constexpr std::size_t most_grouped = 16384;
constexpr bool may_be_grouped(std::size_t daughters) {
  return daughters > most_scanned / 2 && daughters <= most_grouped;
}

/// Searches that no code is generated for.
constexpr bool is_for_data_alone(Candidates candidates) {
  return candidates == Candidates::wires || candidates == Candidates::groups ||
         candidates == Candidates::tree || candidates == Candidates::layers;
}

enum class SafetyFrom : std::uint8_t {
  generic,  ///< left to the generic navigator
  all,      ///< mother and every daughter
  boxes,    ///< mother and the daughters whose boxes are near
  wires,    ///< mother, the wires that are near across, and what is beside them
};

/// Daughters that are tested by the same code: the same solid, or solids of one kind that a table
/// holds, placed with or without rotation.
struct DaughterClass {
  struct Shape {
    kernels::AnySolid<double> solid;
    Extent extent;  ///< of the solid, in its own frame
  };
  std::vector<Shape> shapes;  ///< more than one: a table
  bool rotated = false;
  bool box_first = false;                 ///< the solids are costly: test their boxes before
  std::vector<std::uint32_t> members;     ///< ascending
  std::vector<std::uint32_t> shape_of{};  ///< by member

  SolidKind kind() const { return shapes[0].solid.kind; }
  bool from_table() const { return shapes.size() > 1; }
};

struct ScenePlan {
  VolumeId volume = 0;
  FrameFacts frame;
  std::optional<VolumeId> only_mother;  ///< where all placements are in the same volume
  Candidates candidates = Candidates::none;
  Grid grid;                  ///< for cells and boxes
  std::vector<Extent> boxes;  ///< by daughter, with a margin for single precision
  Slabs slabs;
  Nest nest;
  Rings rings;
  Wires wires;
  /// For daughters that are bound to data, while code has the candidates; beside slabs and wires
  /// for the safety alone.
  Layers layers;
  SafetyFrom safety = SafetyFrom::generic;
  std::vector<Extent> tree_boxes;  ///< for safety: by daughter, as the generic navigator inflates
  /// Steps from within a daughter, and those along faces where oblique_only, are left to the
  /// generic navigator: without them there is much less code.
  bool bail_out_rare = false;
  bool oblique_only = false;     ///< because of boxes along the axes of the frame
  bool neighbour_lists = false;  ///< on leaving a daughter only its neighbours are asked
  std::vector<DaughterClass> classes;
  double mean_candidates = 0;  ///< expected candidates per cell, by volume
  std::string pattern;         ///< in words: "leaf", "70 slabs along z", "grid 4 x 4", ...
};

}  // namespace navjit
