// All decisions about the specialised navigator of one scene, as data. They are printed by `navjit
// inspect` and turned into text by codegen, which decides nothing itself.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/searches.hpp"
#include "geometry/navigation/geometry.hpp"

namespace navjit {

/// What is known about the frames of a volume over all its touchables.
struct FrameFacts {
  /// Whether no touchable of this volume is rotated in the world.
  bool never_rotated = false;
  /// The rotation that all touchables share, if there is only one and it is not the identity.
  std::optional<std::array<double, 9>> only_rotation;
  unsigned rotation = 0;  ///< number of only_rotation in the world, from 1; 0 for none
  /// The translation of the frame, if the volume has a single touchable.
  std::optional<std::array<double, 3>> only_translation;
};

/// A regular partition of the scene into cells along one to three axes, each with the daughters
/// that reach into it. In stacks, grids, lattices and rings, cells have few candidates.
struct Grid {
  std::array<int, 3> count{1, 1, 1};   ///< 1 on axes that are not split
  std::array<double, 3> origin{};      ///< lower edge, mm
  std::array<double, 3> width{};       ///< of a cell, mm
  std::vector<std::uint32_t> first;    ///< by cell, and one more: start in `members`
  std::vector<std::uint32_t> members;  ///< daughter indices, ascending within a cell

  std::size_t size() const { return first.empty() ? 0 : first.size() - 1; }
};

/// Daughters that follow one another along an axis. A slab's position is its number along the axis.
struct Slabs {
  int axis = 0;
  std::vector<std::uint32_t> members;  ///< daughter indices, by position
  std::vector<double> low, high;       ///< by position, with the margin, mm
  double origin = 0, width = 0;        ///< of the cells, mm
  /// A track that came out of a slab does not meet it again if it is no deeper than this within
  /// `low` or `high`, mm; 0 unless all daughters are boxes along the axes.
  double skin = 0;
  /// By cell: the first position that a ray from there may meet if it ascends, and the first if it
  /// descends.
  std::vector<std::uint32_t> ascending, descending;
};

/// Slabs within slabs. Planes between daughters separate them into slabs along an axis, and the
/// contents of each slab into slabs along another axis, until one daughter is left, or a group that
/// no such plane divides. Examples are layers of rows of tiles, planes of bars, and lattices of
/// straws.
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
  double mean_group = 0;  ///< the mean over daughters of how many are asked together

  bool found() const { return !divisions.empty(); }
};

/// Daughters that surround an axis or a centre as shells, with both radii ascending.
struct Nest {
  int axis = 2;                        ///< 3: about the mother's origin
  std::vector<std::uint32_t> members;  ///< daughter indices, by position
  std::vector<double> near2, far2;     ///< by position, squared radii with the margin, mm^2
  /// Whether rays in the mother come beyond the ends of all shells, and these ends with the margin,
  /// mm.
  bool ends = false;
  double low = 0, high = 0;
  std::vector<std::uint32_t> others;  ///< daughters that are not shells
};

/// Daughters at equal steps of azimuth about an axis, and the sectors that they are in.
struct Ring {
  double near = 0, far = 0, low = 0, high = 0;  ///< with the margin, mm
  /// Whether a ray in the mother may be nearer to the axis, farther from it, or beyond the ends.
  bool hole = false, outside = false, ends = false;
  bool segments = false;  ///< whether all are cut to a segment of azimuth about the ring's own axis
  int steps = 0;          ///< in a full turn, each with a sector
  int present = 0;        ///< daughters
  double reach = 0;       ///< within this of an edge the sector beyond the edge counts, too, mm
  double lean = 0;  ///< radius of the circle whose tangents the edges are, mm; 0 if they are radii
  std::vector<std::array<double, 2>> edges;  ///< unit vectors along lower edges; the first again
  std::vector<std::uint32_t> at_angle;  ///< by cell of kernels::square_angle: sector it begins in
  std::vector<std::uint32_t> first;     ///< by sector, and one more: start in `members`
  std::vector<std::uint32_t> members;   ///< daughter indices, ascending within a sector
};

struct Rings {
  int axis = 2;
  std::vector<Ring> rings;
  std::vector<std::uint32_t> others;  ///< daughters in no ring
};

/// Parallel wires in a row. Their places across the wires are given by u along the row and n along
/// its normal.
struct WireRow {
  double at = 0;                       ///< n of the row's middle, mm
  double half_u = 0, half_n = 0;       ///< of a rectangle about a wire's u and the row's n, mm
  double radius = 0;                   ///< of a circle; both hold any wire, with the margin, mm
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
  /// Whether rays in the mother come beyond the ends of all wires, and these ends with the margin,
  /// mm.
  bool ends = false;
  double low = 0, high = 0;
};

struct Wires {
  std::vector<WireBundle> bundles;
  std::vector<std::uint32_t> others;  ///< daughters that are in no row
  /// Whether distances across the wires are lower bounds of what each wire's safety_to_in gives.
  bool safety_known = false;
};

/// The most daughters that Candidates::scan may have.
constexpr std::size_t most_scanned = 64;
constexpr bool may_be_scanned(std::size_t daughters) {
  return daughters > 1 && daughters <= most_scanned;
}
/// The most daughters that Candidates::groups may have. A guess.
constexpr std::size_t most_grouped = 16384;
constexpr bool may_be_grouped(std::size_t daughters) {
  return daughters > most_scanned / 2 && daughters <= most_grouped;
}

enum class SafetyFrom : std::uint8_t {
  generic,  ///< left to the generic navigator
  all,      ///< mother and every daughter
  boxes,    ///< mother and the daughters whose boxes are near
  wires,    ///< mother, the wires that are near across, and the daughters beside the wires
};

/// Daughters that are tested by the same code. They have the same solid, or solids of one kind that
/// are in a table, and are placed with or without rotation.
struct DaughterClass {
  struct Shape {
    kernels::AnySolid<double> solid;
    Extent extent;  ///< of the solid, in its own frame
  };
  std::vector<Shape> shapes;  ///< more than one if they are in a table
  bool rotated = false;
  bool box_first = false;              ///< the solids are costly, so their boxes are tested first
  std::vector<std::uint32_t> members;  ///< ascending
  std::vector<std::uint32_t> shape_of{};  ///< by member

  SolidKind kind() const { return shapes[0].solid.kind; }
  bool from_table() const { return shapes.size() > 1; }
};

struct ScenePlan {
  VolumeId volume = 0;
  FrameFacts frame;
  std::optional<VolumeId> only_mother;  ///< the volume in which all placements are
  Candidates candidates = Candidates::none;
  Grid grid;                  ///< for cells and boxes
  std::vector<Extent> boxes;  ///< by daughter, with a margin for single precision
  Slabs slabs;
  Nest nest;
  Rings rings;
  Wires wires;
  /// For scenes that are bound to data, while code uses `candidates`. With slabs and wires they are
  /// there only for the safety.
  Layers layers;
  SafetyFrom safety = SafetyFrom::generic;
  std::vector<Extent> tree_boxes;  ///< for safety: by daughter, as the generic navigator inflates
  /// Steps from within a daughter and, if oblique_only, those along faces are left to the generic
  /// navigator. This saves much code.
  bool bail_out_rare = false;
  bool oblique_only = false;     ///< because daughters are boxes along the axes of the frame
  bool neighbour_lists = false;  ///< on leaving a daughter only its neighbours are asked
  std::vector<DaughterClass> classes;
  double mean_candidates = 0;  ///< the expected number in a cell, weighted by volume
  std::string pattern;         ///< in words: "leaf", "70 slabs along z", "grid 4 x 4", ...
};

}  // namespace navjit
