#include "geometry/navigation/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/bvh/box_tree_traversal.hpp"
#include "geometry/solids/extent.hpp"

namespace navjit {
namespace {

/// With more neighbours than this the tree of boxes is the better search: a guess.
constexpr std::size_t most_neighbours = 32;
/// In a lattice of thousands of daughters, each with 26 neighbours, the lists that a step reads are
/// in no cache: then a search of the scene is faster. A lattice of 1728 (1.4 MB) was slower without
/// its lists, and one of 4096 (3.5 MB) was 1.3 times as fast without them.
constexpr std::size_t most_bytes = 1'500'000;
/// A few neighbours take a few cache lines, where a search reads several: detectors of 4800 to
/// 11,520 daughters with 4 to 7 neighbours each (200 to 330 bytes, 1.6 to 2.9 MB) were 1.03 to 1.41
/// times as fast with lists, three arrays made for this test 0.88 to 1.02. With 19,000 to 42,000 (4
/// to 8.5 MB) it was 0.96 to 1.11, and 0.59 to 0.91 an hour later: others use that cache, too.
constexpr std::size_t most_bytes_each = 400, most_bytes_of_few = 3'000'000;
/// From this number of neighbours on they have blocks of boxes: a guess.
constexpr std::size_t blocks_from = 3;

/// Rounding to the nearest float keeps the order: a point in the box, once it is rounded, is in the
/// rounded box.
void append_blocks(std::span<const std::uint32_t> found, std::span<const Extent> boxes,
                   double margin, std::vector<kernels::BoxBlock>& blocks) {
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto lane = i % kernels::box_lanes;
    if (lane == 0) {
      kernels::BoxBlock& block = blocks.emplace_back();
      std::fill_n(block.low, 3, kernels::all_lanes(std::numeric_limits<float>::infinity()));
      std::fill_n(block.high, 3, kernels::all_lanes(-std::numeric_limits<float>::infinity()));
    }
    const Extent box = inflated(boxes[found[i]], margin);
    const double low[3] = {box.min.x, box.min.y, box.min.z};
    const double high[3] = {box.max.x, box.max.y, box.max.z};
    for (int axis = 0; axis < 3; ++axis) {
      blocks.back().low[axis][lane] = static_cast<float>(low[axis]);
      blocks.back().high[axis][lane] = static_cast<float>(high[axis]);
    }
  }
}

/// Parts of a box smaller than this fraction of its radius are not divided: a guess.
constexpr double least_part = 1.0 / 64;
/// All boxes of a scene's daughters together are not divided into more parts: a guess.
constexpr std::size_t most_parts_of_all = 4'000'000;

Vec3 centre_of(const Extent& e) {
  return {(e.min.x + e.max.x) / 2, (e.min.y + e.max.y) / 2, (e.min.z + e.max.z) / 2};
}

double radius_of(const Extent& e) {
  return std::hypot(e.max.x - e.min.x, e.max.y - e.min.y, e.max.z - e.min.z) / 2;
}

/// Cuts the box in the middle of its longest edge. Keeps one half and returns the other.
Extent cut_in_half(Extent& box) {
  Extent other = box;
  double* const low[3] = {&other.min.x, &other.min.y, &other.min.z};
  double* const high[3] = {&box.max.x, &box.max.y, &box.max.z};
  const double edges[3] = {*high[0] - box.min.x, *high[1] - box.min.y, *high[2] - box.min.z};
  const auto axis = std::max_element(edges, edges + 3) - edges;
  *low[axis] = *high[axis] = (*low[axis] + *high[axis]) / 2;
  return other;
}

/// Asks for safeties at the centres of parts; a part whose safety is too small is divided.
bool holds_parts_deep(const kernels::AnySolid<double>& mother, const Extent& box, double margin,
                      std::size_t most_parts) {
  const double least_radius = least_part * radius_of(box);
  std::vector<Extent> parts{box};
  for (std::size_t asked = 1; !parts.empty(); ++asked) {
    Extent part = parts.back();
    parts.pop_back();
    const double safety = safety_to_out(mother, centre_of(part)), radius = radius_of(part);
    if (safety > radius + margin) continue;
    // If the centre itself is not deep enough, no division helps.
    if (!(safety > margin) || radius < least_radius || asked >= most_parts) return false;
    parts.push_back(cut_in_half(part));
    parts.push_back(part);
  }
  return true;
}

}  // namespace

bool holds_deep(const Solid& mother, const Extent& box, double margin, std::size_t most_parts) {
  if (mother.kind == SolidKind::box) {
    const Extent deep = inflated(mother.extent, -margin);
    return box.min.x > deep.min.x && box.max.x < deep.max.x && box.min.y > deep.min.y &&
           box.max.y < deep.max.y && box.min.z > deep.min.z && box.max.z < deep.max.z;
  }
  return holds_parts_deep(mother.any(), box, margin, most_parts);
}

double search_margin(const Extent& extent, double tolerance) {
  return 2 * tolerance + 1e-9 * largest_coordinate(extent);
}

bool NeighbourLists::are_near() const { return bytes() <= most_bytes; }

std::size_t NeighbourLists::bytes() const {
  return of.size() * sizeof(of[0]) + neighbours.size() * sizeof(neighbours[0]) +
         blocks.size() * sizeof(blocks[0]);
}

NeighbourLists find_neighbours(const Solid& mother, std::span<const Extent> boxes,
                               const bvh::BoxTree* tree, double tolerance) {
  NeighbourLists result;
  // Daughters may stick out of their mother: so their boxes count for the margin.
  double margin = search_margin(mother.extent, tolerance);
  for (const Extent& box : boxes) margin = std::max(margin, search_margin(box, tolerance));
  if (!std::isfinite(margin)) return result;
  result.of.reserve(boxes.size());
  const std::size_t most_parts =
      std::min(most_parts_of_box, most_parts_of_all / std::max<std::size_t>(boxes.size(), 1));
  std::vector<std::uint32_t> found;
  for (std::uint32_t k = 0; k < boxes.size(); ++k) {
    const Extent box = inflated(boxes[k], margin);
    found.clear();
    const auto test = [&](std::uint32_t other) {
      if (other != k && meet(box, inflated(boxes[other], margin))) found.push_back(other);
      return found.size() <= most_neighbours;
    };
    if (tree != nullptr) {
      // The tree's own boxes reach out by less.
      tree->overlapping(inflated(box, margin), test);
    } else {
      for (std::uint32_t other = 0; other < boxes.size(); ++other) test(other);
    }
    std::sort(found.begin(), found.end(), std::greater<>());
    const bool listed = found.size() <= most_neighbours;
    const bool in_blocks = listed && found.size() >= blocks_from;
    result.of.push_back(
        {{box.min.x, box.min.y, box.min.z},
         {box.max.x, box.max.y, box.max.z},
         static_cast<std::uint32_t>(result.neighbours.size()),
         listed ? static_cast<std::uint16_t>(found.size()) : NeighbourLists::Of::unlisted,
         holds_deep(mother, box, margin, most_parts),
         in_blocks ? static_cast<std::uint32_t>(result.blocks.size())
                   : NeighbourLists::Of::no_block,
         static_cast<float>(margin)});
    if (listed) result.neighbours.insert(result.neighbours.end(), found.begin(), found.end());
    if (in_blocks) append_blocks(found, boxes, margin, result.blocks);
    if (result.bytes() > most_bytes_of_few) return {};
  }
  if (!result.are_near() && result.bytes() > most_bytes_each * boxes.size()) return {};
  return result;
}

}  // namespace navjit
