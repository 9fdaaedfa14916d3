// What a track may meet where it leaves a daughter is known beforehand: few others touch it.
//
// A daughter's box with a margin holds every point at which a track can leave it. Only daughters
// whose boxes, with the same margin, meet that box can contain such a point; and where the box lies
// well inside the mother, the mother contains it. The margin is far above the tolerance and the
// rounding of a position, so that no answer depends on it.
//
// Several neighbours have their boxes, with that margin and in single precision, in blocks of
// eight: mostly one look shows that none or one of them can contain the point.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/solids/box_blocks.hpp"
#include "geometry/solids/solid.hpp"

#include "geometry/kernels/neighbour_list.h"

namespace navjit {

namespace bvh {
class BoxTree;
}

struct NeighbourLists {
  using Of = kernels::NeighbourList;
  std::vector<Of> of;                     ///< by daughter; empty: not known
  std::vector<std::uint32_t> neighbours;  ///< of each daughter, last in file order first
  std::vector<kernels::BoxBlock> blocks;  ///< of the neighbours, in that order

  /// The memory that this holds.
  std::size_t bytes() const;
  /// Whether all of it stays in a processor's cache.
  bool are_near() const;
  /// The neighbours of a daughter; null if they are unknown or the point is not in its box.
  const Of* at(unsigned daughter, const Vec3& p) const {
    return daughter < of.size() && is_there(of[daughter], p) ? &of[daughter] : nullptr;
  }
  std::span<const std::uint32_t> neighbours_of(const Of& around) const {
    return std::span(neighbours).subspan(around.first, around.count);
  }
};

/// `boxes` are around the daughters, in their mother's frame; `tree` holds the same boxes, or is
/// null. The lists are empty where a search would read less than they hold.
NeighbourLists find_neighbours(const Solid& mother, std::span<const Extent> boxes,
                               const bvh::BoxTree* tree, double tolerance);

/// A box is asked about in no more parts than this: a guess.
constexpr std::size_t most_parts_of_box = 512;

/// Whether every point of the box is deeper in the solid than the margin. The safeties of at most
/// `most_parts` of its parts, and of one at least, tell it; false where that is not known.
bool holds_deep(const Solid& mother, const Extent& box, double margin,
                std::size_t most_parts = most_parts_of_box);

/// How far boxes and cells of a scene reach beyond its daughters, mm: twice the tolerance and
/// 1e-9 of the largest coordinate, a million times the rounding of a position.
double search_margin(const Extent& extent, double tolerance);

/// How far the boxes of the generic navigator reach beyond daughters, mm. A point that is within
/// the tolerance of three faces of a turned box is up to sqrt(3) tolerances away from their corner,
/// and so perhaps from the box around it.
inline double box_margin(double tolerance) { return 2 * tolerance; }

}  // namespace navjit
