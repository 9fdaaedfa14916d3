#include "analysis/patterns/nest.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/axial_extent.hpp"

namespace navjit {
namespace {

/// If shells overlap more than this on average, counted over the radii that they cover, they hardly
/// narrow a search down.
constexpr double most_overlap = 1.5;

/// Fewer shells are not a nest.
constexpr std::size_t fewest = 3;

constexpr double half_turn = std::numbers::pi;

AxialExtent extent_about(const Solid& solid, const Transformation& frame, int axis) {
  return axis == 3 ? central_extent(solid, frame) : axial_extent(solid, frame, axis);
}

/// Whether both radii ascend, and most radii are in one shell only.
bool ascend(const std::vector<AxialExtent>& extents, const std::vector<std::uint32_t>& order) {
  double sum = 0, covered = 0, end = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const AxialExtent& e = extents[order[i]];
    if (i > 0 && (e.far < extents[order[i - 1]].far || e.near < extents[order[i - 1]].near)) {
      return false;
    }
    if (i > 0 && !(e.near > 0)) return false;  // only the innermost has no bore
    sum += e.far - e.near;
    covered += e.far - std::max(std::min(end, e.far), e.near);
    end = e.far;
  }
  return sum <= most_overlap * covered;
}

/// Sets the ends of all shells, and whether the mother reaches so far beyond them that a test of
/// the ends pays.
void clip_ends(const std::vector<AxialExtent>& extents, const AxialExtent& mother, double margin,
               Nest& nest) {
  nest.low = mother.high;
  nest.high = mother.low;
  for (const std::uint32_t k : nest.members) {
    nest.low = std::min(nest.low, extents[k].low - margin);
    nest.high = std::max(nest.high, extents[k].high + margin);
  }
  const double worth_it = 0.1 * (nest.high - nest.low);
  nest.ends = mother.low < nest.low - worth_it || mother.high > nest.high + worth_it;
}

}  // namespace

std::optional<Nest> find_nest(const World& world, const Solid& mother,
                              std::span<const Daughter> daughters, double margin) {
  std::optional<Nest> best;
  for (const int axis : {2, 0, 1, 3}) {
    std::vector<AxialExtent> extents;
    Nest nest;
    nest.axis = axis;
    const AxialExtent around = extent_about(mother, Transformation{}, axis);
    double largest = around.far;
    for (std::uint32_t k = 0; k < daughters.size(); ++k) {
      extents.push_back(extent_about(world.volumes[daughters[k].volume].solid,
                                     daughters[k].transformation, axis));
      const AxialExtent& e = extents.back();
      largest = std::max(largest, e.far);
      // Shells go around the axis by more than half a turn. Other daughters are not shells.
      (e.around || e.span > half_turn ? nest.members : nest.others).push_back(k);
    }
    std::sort(nest.members.begin(), nest.members.end(), [&](std::uint32_t a, std::uint32_t b) {
      return extents[a].near + extents[a].far < extents[b].near + extents[b].far;
    });
    if (nest.members.size() < fewest || !ascend(extents, nest.members)) continue;
    if (best && best->members.size() >= nest.members.size()) continue;
    // Squares of radii near the axis are lost in the rounding of squared radii far from it, up to
    // the mother's own surface.
    const double slack = 0x1p-44 * largest * largest;
    for (const std::uint32_t k : nest.members) {
      const double near = std::max(extents[k].near - margin, 0.0), far = extents[k].far + margin;
      nest.near2.push_back(near * near - slack);
      nest.far2.push_back(far * far + slack);
    }
    if (axis < 3) clip_ends(extents, around, margin, nest);
    best = std::move(nest);
  }
  return best;
}

}  // namespace navjit
