#include "analysis/plates.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/axis.hpp"

namespace navjit {
namespace {

/// Buckets for each daughter: where they are small against daughters and gaps, most have one first
/// candidate alone.
constexpr std::size_t buckets_per_daughter = 8;
constexpr std::size_t most_buckets = 4096;

/// Daughters by position; empty unless each is well thicker than the tolerance and ends before the
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

Plates lay_out(const Extent& scene, std::span<const Extent> boxes, int axis, double margin,
               std::vector<std::uint32_t> order) {
  Plates plates;
  plates.axis = axis;
  for (const std::uint32_t k : order) {
    plates.low.push_back(low(boxes[k], axis) - margin);
    plates.high.push_back(high(boxes[k], axis) + margin);
  }
  plates.members = std::move(order);
  const std::size_t n = boxes.size();
  const std::size_t buckets = std::min(most_buckets, buckets_per_daughter * n);
  plates.origin = low(scene, axis);
  plates.width = (high(scene, axis) - plates.origin) / static_cast<double>(buckets);
  for (std::size_t b = 0; b < buckets; ++b) {
    const double begin = plates.origin + static_cast<double>(b) * plates.width;
    // The outermost buckets hold what lies beyond them, too.
    const auto up = b == 0 ? plates.high.begin()
                           : std::lower_bound(plates.high.begin(), plates.high.end(), begin);
    const auto beyond = b + 1 == buckets ? plates.low.end()
                                         : std::upper_bound(plates.low.begin() + 1,
                                                            plates.low.end(), begin + plates.width);
    plates.ascending.push_back(static_cast<std::uint32_t>(up - plates.high.begin()));
    plates.descending.push_back(static_cast<std::uint32_t>(beyond - plates.low.begin() - 1));
  }
  return plates;
}

}  // namespace

std::optional<Plates> find_plates(const Extent& scene, std::span<const Extent> boxes,
                                  double tolerance, double margin) {
  if (boxes.size() < 2) return {};
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<std::uint32_t> order = in_order(boxes, axis, tolerance);
    if (!order.empty()) return lay_out(scene, boxes, axis, margin, std::move(order));
  }
  return {};
}

}  // namespace navjit
