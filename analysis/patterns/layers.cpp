#include "analysis/patterns/layers.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "analysis/axis.hpp"
#include "analysis/patterns/slabs.hpp"

namespace navjit {
namespace {

/// The levels of slabs. More than three follow one another only if layers differ.
constexpr int most_levels = 8;
/// A group of more daughters than this is better searched by the hierarchy of boxes. A guess, as is
/// the mean number that may be asked together.
constexpr std::size_t most_in_group = 64;
constexpr double most_mean_group = 8;
/// Slabs may overlap by this share of the thinner one. Rows of straws that stand on the gaps
/// between others overlap by an eighth, and in one detector layers overlap by mistake.
constexpr double most_overlap = 0.25;
constexpr std::size_t cells_per_slab = 2, most_cells = 4096;

/// Members in an order along an axis, where each slab begins in this order, and the end.
struct Cut {
  std::vector<std::uint32_t> order;
  std::vector<std::size_t> first;

  std::size_t slabs() const { return first.size() - 1; }
};

Cut cut_along(std::span<const std::uint32_t> members, std::span<const Extent> boxes, int axis,
              double tolerance) {
  Cut cut{{members.begin(), members.end()}, {}};
  std::stable_sort(cut.order.begin(), cut.order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return low(boxes[a], axis) < low(boxes[b], axis);
  });
  double begin = 0, reach = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < cut.order.size(); ++i) {
    const double from = low(boxes[cut.order[i]], axis), to = high(boxes[cut.order[i]], axis);
    // The overlap is less than the thickness of the next slab, so that lower and upper bounds both
    // ascend.
    const double overlap =
        std::max(tolerance / 4, most_overlap * std::min(reach - begin, to - from));
    if (i == 0 || (from >= reach - overlap && to > reach)) {
      cut.first.push_back(i);
      begin = from;
    }
    reach = std::max(reach, to);
  }
  cut.first.push_back(cut.order.size());
  return cut;
}

/// Divides a scene, level by level.
struct Builder {
  std::span<const Extent> boxes;
  double tolerance, margin;
  Layers layers{};
  bool failed = false;

  Layers::Part group(std::span<const std::uint32_t> members) {
    if (members.size() > most_in_group) failed = true;
    std::vector<std::uint32_t> sorted(members.begin(), members.end());
    std::sort(sorted.begin(), sorted.end());
    const auto size = static_cast<double>(members.size());
    layers.mean_group += size * size / static_cast<double>(boxes.size());
    layers.groups.push_back(std::move(sorted));
    return {Layers::Kind::group, static_cast<std::uint32_t>(layers.groups.size() - 1)};
  }

  Layers::Part divide(std::span<const std::uint32_t> members, int level) {
    if (members.size() == 1) {
      layers.mean_group += 1 / static_cast<double>(boxes.size());
      return {Layers::Kind::daughter, members[0]};
    }
    // Divides along the axis with the most slabs. So layers come before the rows in each of them,
    // if there are more layers than rows.
    Cut best;
    int axis = 3;
    for (int a = 0; a < 3 && level < most_levels; ++a) {
      Cut cut = cut_along(members, boxes, a, tolerance);
      if (cut.slabs() > 1 && (axis == 3 || cut.slabs() > best.slabs())) {
        best = std::move(cut);
        axis = a;
      }
    }
    if (axis == 3) return group(members);
    const auto number = static_cast<std::uint32_t>(layers.divisions.size());
    layers.divisions.emplace_back();
    Slabs slabs;
    slabs.axis = axis;
    std::vector<Layers::Part> parts;
    for (std::size_t i = 0; i < best.slabs() && !failed; ++i) {
      const std::span part(best.order.data() + best.first[i], best.first[i + 1] - best.first[i]);
      double from = low(boxes[part[0]], axis), to = high(boxes[part[0]], axis);
      for (const std::uint32_t k : part) to = std::max(to, high(boxes[k], axis));
      slabs.low.push_back(from - margin);
      slabs.high.push_back(to + margin);
      parts.push_back(divide(part, level + 1));
    }
    if (failed) return {};
    const std::size_t cells = std::min(most_cells, cells_per_slab * slabs.low.size());
    divide_into_cells(slabs, slabs.low.front(), slabs.high.back(), cells);
    layers.divisions[number] = {std::move(slabs), std::move(parts)};
    return {Layers::Kind::slabs, number};
  }
};

}  // namespace

std::optional<Layers> find_layers(std::span<const Extent> boxes, double tolerance, double margin) {
  if (boxes.size() < 2) return {};
  Builder builder{boxes, tolerance, margin};
  std::vector<std::uint32_t> all(boxes.size());
  std::iota(all.begin(), all.end(), 0U);
  const Layers::Part whole = builder.divide(all, 0);
  if (builder.failed || whole.kind != Layers::Kind::slabs ||
      builder.layers.mean_group > most_mean_group) {
    return {};
  }
  return std::move(builder.layers);
}

std::string describe_layers(const Layers& layers) {
  std::string text;
  // Follows the largest part of each division, which represents the others.
  for (std::size_t at = 0;;) {
    const Layers::Division& d = layers.divisions[at];
    text += (text.empty() ? "" : " of ") + std::to_string(d.parts.size()) +
            (text.empty() ? " layers along " : " along ") + "xyz"[d.slabs.axis];
    std::size_t next = 0, most = 0;
    for (const Layers::Part& part : d.parts) {
      if (part.kind != Layers::Kind::slabs) continue;
      const std::size_t parts = layers.divisions[part.number].parts.size();
      if (parts > most) {
        most = parts;
        next = part.number;
      }
    }
    if (most == 0) return text;
    at = next;
  }
}

}  // namespace navjit
