#include "geometry/bvh/clustering.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace navjit::bvh {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The bounding box of the boxes added so far.
class Bounds {
 public:
  void add(const Extent& box) {
    min_ = {std::min(min_.x, box.min.x), std::min(min_.y, box.min.y), std::min(min_.z, box.min.z)};
    max_ = {std::max(max_.x, box.max.x), std::max(max_.y, box.max.y), std::max(max_.z, box.max.z)};
  }
  double half_surface() const {
    const double x = max_.x - min_.x, y = max_.y - min_.y, z = max_.z - min_.z;
    return x * y + y * z + z * x;
  }

 private:
  Vec3 min_{infinity, infinity, infinity}, max_{-infinity, -infinity, -infinity};
};

class Divider {
 public:
  Divider(std::span<const Extent> boxes, std::uint32_t capacity)
      : boxes_(boxes), capacity_(capacity), order_(boxes.size()), surface_below_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
  }

  Clusters run() {
    begin_.push_back(0);
    if (!order_.empty()) divide(order_);
    return {std::move(order_), std::move(begin_)};
  }

 private:
  struct Cut {
    double cost;
    std::size_t below;  ///< boxes on the lower side
  };

  void divide(std::span<std::uint32_t> members) {
    if (members.size() <= capacity_) {
      std::sort(members.begin(), members.end());
      begin_.push_back(begin_.back() + static_cast<std::uint32_t>(members.size()));
      return;
    }
    // Boxes without a finite surface have no cost to compare: any place to cut will do.
    Cut best{infinity, middle(members.size())};
    int best_axis = 0;
    for (int axis = 0; axis < 3; ++axis) {
      sort_along(axis, members);
      const Cut cut = best_cut(members);
      if (cut.cost < best.cost) {
        best = cut;
        best_axis = axis;
      }
    }
    sort_along(best_axis, members);
    divide(members.first(best.below));
    divide(members.subspan(best.below));
  }

  /// The best place to cut a sorted sequence in two.
  Cut best_cut(std::span<const std::uint32_t> members) {
    const std::size_t count = members.size();
    Bounds below, above;
    for (std::size_t i = 0; i < count; ++i) {
      below.add(boxes_[members[i]]);
      surface_below_[i] = below.half_surface();
    }
    const std::size_t half = middle(count);
    const auto off_centre = [half](std::size_t i) { return i > half ? i - half : half - i; };
    Cut best{infinity, half};
    for (std::size_t i = count - 1; i > 0; --i) {
      above.add(boxes_[members[i]]);
      if (i % capacity_ != 0) continue;
      const std::size_t clusters_below = i / capacity_;
      const std::size_t clusters_above = (count - i + capacity_ - 1) / capacity_;
      const double cost = surface_below_[i - 1] * static_cast<double>(clusters_below) +
                          above.half_surface() * static_cast<double>(clusters_above);
      // Among equal costs, halves: identical boxes must not be split off one cluster at a time.
      const bool better =
          cost < best.cost || (cost == best.cost && off_centre(i) < off_centre(best.below));
      if (better) best = {cost, i};
    }
    return best;
  }

  /// About half of `count` (> capacity) boxes, a whole number of clusters.
  std::size_t middle(std::size_t count) const {
    return std::max<std::size_t>(capacity_, count / 2 / capacity_ * capacity_);
  }

  void sort_along(int axis, std::span<std::uint32_t> members) const {
    std::sort(members.begin(), members.end(), [&](std::uint32_t a, std::uint32_t b) {
      const double at_a = twice_centre(axis, boxes_[a]), at_b = twice_centre(axis, boxes_[b]);
      return at_a != at_b ? at_a < at_b : a < b;
    });
  }

  static double twice_centre(int axis, const Extent& box) {
    const double sum = axis == 0   ? box.min.x + box.max.x
                       : axis == 1 ? box.min.y + box.max.y
                                   : box.min.z + box.max.z;
    return sum == sum ? sum : 0;  // -infinity + infinity has no order
  }

  std::span<const Extent> boxes_;
  std::uint32_t capacity_;
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> begin_;
  std::vector<double> surface_below_;
};

}  // namespace

Clusters cluster_by_surface(std::span<const Extent> boxes, std::uint32_t capacity) {
  return Divider(boxes, capacity).run();
}

}  // namespace navjit::bvh
