#include "geometry/bvh/wide_tree.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "geometry/bvh/clustering.hpp"
#include "geometry/solids/extent.hpp"

namespace navjit::bvh {
namespace {

/// From this level on ranges are halved, whatever their surface, which bounds the levels.
constexpr std::uint32_t levels_by_surface = 16;

double edge(double low, double high) {
  // Limited, since infinite products could not be compared.
  return high > low ? std::min(high - low, 1e30) : 0.0;
}
double half_surface(const Extent& e) {
  const double x = edge(e.min.x, e.max.x), y = edge(e.min.y, e.max.y), z = edge(e.min.z, e.max.z);
  return x * y + y * z + z * x;
}

/// The number of nodes for so many boxes, as a fraction; a single box needs no node.
double nodes_for(std::size_t boxes) {
  return boxes < 2 ? 0.0 : static_cast<double>(boxes + wide_tree_lanes - 3) / (wide_tree_lanes - 1);
}

class Builder {
 public:
  explicit Builder(std::span<const Extent> boxes)
      : boxes_(boxes), low_side_(boxes.size()), surface_above_(boxes.size()), moved_(boxes.size()) {
    std::vector<double> key(boxes.size());
    for (std::size_t o = 0; o < orders; ++o) {
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        const Vec3 centre = bounded_centre(boxes[i]);
        key[i] = o == 0 ? centre.x : o == 1 ? centre.y : o == 2 ? centre.z : half_surface(boxes[i]);
      }
      order_[o].resize(boxes.size());
      std::iota(order_[o].begin(), order_[o].end(), 0u);
      std::stable_sort(order_[o].begin(), order_[o].end(),
                       [&](std::uint32_t a, std::uint32_t b) { return key[a] < key[b]; });
    }
  }

  std::vector<WideNode> run() {
    if (!boxes_.empty()) make_node({0, boxes_.size(), 0}, 0);
    return std::move(nodes_);
  }

 private:
  static constexpr std::size_t orders = 4;  ///< by x, y, z of the centre and by surface

  /// Boxes order_[...][first] to order_[...][last - 1], the same ones in every order.
  struct Range {
    std::size_t first, last;
    double surface;  ///< of their bounding box

    std::size_t size() const { return last - first; }
  };
  struct Cut {
    double cost;
    std::size_t order, at;
  };

  Extent bounds_of(const Range& r) const {
    Extent bounds = boxes_[order_[0][r.first]];
    for (std::size_t i = r.first + 1; i < r.last; ++i) {
      bounds = merged(bounds, boxes_[order_[0][i]]);
    }
    return bounds;
  }
  Range range(std::size_t first, std::size_t last) const {
    Range r{first, last, 0};
    r.surface = half_surface(bounds_of(r));
    return r;
  }

  void try_order(std::size_t o, const Range& r, Cut& best) {
    const std::vector<std::uint32_t>& order = order_[o];
    Extent above = boxes_[order[r.last - 1]];
    for (std::size_t i = r.last - 1; i > r.first; --i) {
      above = merged(above, boxes_[order[i]]);
      surface_above_[i] = half_surface(above);
    }
    Extent below = boxes_[order[r.first]];
    for (std::size_t i = r.first + 1; i < r.last; ++i) {
      const double low = half_surface(below);
      const double cost = low * nodes_for(i - r.first) + surface_above_[i] * nodes_for(r.last - i);
      if (cost < best.cost && is_worth_a_lane(r, i, low)) best = {cost, o, i};
      below = merged(below, boxes_[order[i]]);
    }
  }

  /// A few boxes are separated from many only if the many get a smaller box by that: else a stack
  /// of plates would lose plate after plate. `low`: the surface of what is below `at`.
  bool is_worth_a_lane(const Range& r, std::size_t at, double low) const {
    const std::size_t below = at - r.first, above = r.last - at;
    if (std::min(below, above) * wide_tree_lanes >= r.size()) return true;
    return (below > above ? low : surface_above_[at]) < 0.98 * r.surface;
  }

  /// Puts the same boxes below `at` in all orders as in the order of the cut.
  void apply(const Cut& cut, const Range& r) {
    const std::vector<std::uint32_t>& leading = order_[cut.order];
    for (std::size_t i = r.first; i < r.last; ++i) low_side_[leading[i]] = i < cut.at;
    for (std::size_t o = 0; o < orders; ++o) {
      if (o == cut.order) continue;
      std::size_t low = r.first, high = 0;
      for (std::size_t i = r.first; i < r.last; ++i) {
        const std::uint32_t box = order_[o][i];
        (low_side_[box] ? order_[o][low++] : moved_[high++]) = box;
      }
      std::copy_n(moved_.begin(), high, order_[o].begin() + static_cast<std::ptrdiff_t>(low));
    }
  }

  std::size_t cut(const Range& r, bool halve) {
    // Where surfaces do not decide, it is cut along the longest axis.
    const Extent bounds = bounds_of(r);
    const double x = edge(bounds.min.x, bounds.max.x), y = edge(bounds.min.y, bounds.max.y),
                 z = edge(bounds.min.z, bounds.max.z);
    Cut best{std::numeric_limits<double>::infinity(),
             static_cast<std::size_t>(x >= y && x >= z ? 0
                                      : y >= z         ? 1
                                                       : 2),
             r.first + r.size() / 2};
    if (!halve) {
      for (std::size_t o = 0; o < orders; ++o) try_order(o, r, best);
    }
    apply(best, r);
    return best.at;
  }

  std::uint32_t make_node(const Range& all, std::uint32_t level) {
    const auto node = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    const bool halve = level >= levels_by_surface;
    std::vector<Range> parts{all};
    while (parts.size() < wide_tree_lanes) {
      const auto largest =
          std::max_element(parts.begin(), parts.end(), [&](const Range& a, const Range& b) {
            if ((a.size() > 1) != (b.size() > 1)) return b.size() > 1;
            return halve ? a.size() < b.size() : a.surface < b.surface;
          });
      if (largest->size() == 1) break;
      const Range whole = *largest;
      const std::size_t at = cut(whole, halve);
      *largest = range(whole.first, at);
      parts.push_back(range(at, whole.last));
    }
    for (const Range& part : parts) {
      const bool is_box = part.size() == 1;
      const std::uint32_t number = is_box ? order_[0][part.first] : make_node(part, level + 1);
      // Nodes may have moved.
      WideNode& made = nodes_[node];
      made.lanes[made.count++] = {bounds_of(part), number, is_box};
    }
    return node;
  }

  std::span<const Extent> boxes_;
  std::vector<std::uint32_t> order_[orders];
  std::vector<char> low_side_;  ///< by box: whether it is below the cut
  std::vector<double> surface_above_;
  std::vector<std::uint32_t> moved_;
  std::vector<WideNode> nodes_;
};

}  // namespace

std::vector<WideNode> build_wide_tree(std::span<const Extent> boxes) {
  return Builder(boxes).run();
}

}  // namespace navjit::bvh
