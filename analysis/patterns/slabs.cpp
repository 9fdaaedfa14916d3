#include "analysis/patterns/slabs.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/axis.hpp"

namespace navjit {
namespace {

/// Cells for each daughter. If cells are small compared with daughters and gaps, most have only one
/// first candidate.
constexpr std::size_t cells_per_daughter = 8;
constexpr std::size_t most_cells = 4096;

/// Daughters by position. Empty unless each is much thicker than the tolerance and ends before the
/// next begins, so that a ray enters them one after the other.
std::vector<std::uint32_t> in_order(std::span<const Extent> boxes, int axis, double tolerance) {
  std::vector<std::uint32_t> order(boxes.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return low(boxes[a], axis) < low(boxes[b], axis);
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Extent& box = boxes[order[i]];
    const bool thick = high(box, axis) - low(box, axis) > 8 * tolerance;
    const bool apart = i == 0 || low(box, axis) >= high(boxes[order[i - 1]], axis) - tolerance / 4;
    if (!thick || !apart) return {};
  }
  return order;
}

Slabs lay_out(const Extent& scene, std::span<const Extent> boxes, int axis, double margin,
              std::vector<std::uint32_t> order) {
  Slabs slabs;
  slabs.axis = axis;
  for (const std::uint32_t k : order) {
    slabs.low.push_back(low(boxes[k], axis) - margin);
    slabs.high.push_back(high(boxes[k], axis) + margin);
  }
  slabs.members = std::move(order);
  divide_into_cells(slabs, low(scene, axis), high(scene, axis),
                    std::min(most_cells, cells_per_daughter * boxes.size()));
  return slabs;
}

}  // namespace

void divide_into_cells(Slabs& slabs, double from, double to, std::size_t cells) {
  slabs.origin = from;
  slabs.width = (to - from) / static_cast<double>(cells);
  for (std::size_t b = 0; b < cells; ++b) {
    const double begin = from + static_cast<double>(b) * slabs.width;
    // The outermost cells also hold what lies beyond them.
    const auto up =
        b == 0 ? slabs.high.begin() : std::lower_bound(slabs.high.begin(), slabs.high.end(), begin);
    const auto beyond = b + 1 == cells ? slabs.low.end()
                                       : std::upper_bound(slabs.low.begin() + 1, slabs.low.end(),
                                                          begin + slabs.width);
    slabs.ascending.push_back(static_cast<std::uint32_t>(up - slabs.high.begin()));
    slabs.descending.push_back(static_cast<std::uint32_t>(beyond - slabs.low.begin() - 1));
  }
}

std::optional<Slabs> find_slabs(const Extent& scene, std::span<const Extent> boxes,
                                double tolerance, double margin) {
  if (boxes.size() < 2) return {};
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<std::uint32_t> order = in_order(boxes, axis, tolerance);
    if (!order.empty()) return lay_out(scene, boxes, axis, margin, std::move(order));
  }
  return {};
}

}  // namespace navjit
