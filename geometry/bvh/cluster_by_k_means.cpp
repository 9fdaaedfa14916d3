#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

#include "geometry/bvh/clustering.hpp"

namespace navjit::bvh {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int max_rounds = 16;  // more rounds move few boxes, and equalise() moves more

double distance2(const Vec3& a, const Vec3& b) {
  const double x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
  return x * x + y * y + z * z;
}

class KMeans {
 public:
  KMeans(std::span<const Extent> boxes, std::uint32_t capacity)
      : capacity_(capacity), count_((boxes.size() + capacity - 1) / capacity) {
    for (const Extent& box : boxes) points_.push_back(bounded_centre(box));
  }

  Clusters run() {
    if (count_ <= 1) {
      cluster_of_.assign(points_.size(), 0);
      members_.assign(count_, points_.size());
    } else {
      draw_centres();
      for (int round = 0; assign() && round < max_rounds; ++round) move_centres();
      equalise();
    }
    return collect();
  }

 private:
  /// Each centre is one of the points, drawn with a probability in proportion to its squared
  /// distance from the centres drawn before (Arthur and Vassilvitskii, "k-means++", 2007).
  void draw_centres() {
    std::mt19937_64 random(1);  // any seed will do, if it is always the same
    std::vector<double> far(points_.size(), infinity);
    centres_.push_back(points_[0]);
    while (centres_.size() < count_) {
      double sum = 0;
      for (std::size_t i = 0; i < points_.size(); ++i) {
        far[i] = std::min(far[i], distance2(points_[i], centres_.back()));
        sum += far[i];
      }
      double rest = sum * (static_cast<double>(random() >> 11) * 0x1p-53);
      std::size_t drawn = 0;
      while (drawn + 1 < far.size() && rest >= far[drawn]) rest -= far[drawn++];
      centres_.push_back(points_[drawn]);
    }
  }

  /// Assigns every point to the nearest centre; false if nothing changed.
  bool assign() {
    bool changed = cluster_of_.empty();
    cluster_of_.resize(points_.size());
    members_.assign(count_, 0);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const std::uint32_t best = nearest(points_[i], [](std::size_t) { return true; });
      changed = changed || best != cluster_of_[i];
      cluster_of_[i] = best;
      ++members_[best];
    }
    return changed;
  }

  template <class Allowed>
  std::uint32_t nearest(const Vec3& p, const Allowed& allowed) const {
    std::size_t best = 0;
    double least = infinity;
    for (std::size_t c = 0; c < count_; ++c) {
      const double d = distance2(p, centres_[c]);
      if (d < least && allowed(c)) {
        least = d;
        best = c;
      }
    }
    return static_cast<std::uint32_t>(best);
  }

  void move_centres() {
    std::vector<Vec3> sums(count_, Vec3{0, 0, 0});
    for (std::size_t i = 0; i < points_.size(); ++i) {
      Vec3& sum = sums[cluster_of_[i]];
      sum = {sum.x + points_[i].x, sum.y + points_[i].y, sum.z + points_[i].z};
    }
    for (std::size_t c = 0; c < count_; ++c) {
      if (members_[c] == 0) continue;
      const auto n = static_cast<double>(members_[c]);
      centres_[c] = {sums[c].x / n, sums[c].y / n, sums[c].z / n};
    }
  }

  /// Fills all clusters but the smallest, which becomes the last.
  void equalise() {
    const auto smallest = static_cast<std::uint32_t>(
        std::min_element(members_.begin(), members_.end()) - members_.begin());
    const auto last = static_cast<std::uint32_t>(count_ - 1);
    std::swap(members_[smallest], members_[last]);
    std::swap(centres_[smallest], centres_[last]);
    for (std::uint32_t& c : cluster_of_) c = c == smallest ? last : c == last ? smallest : c;
    std::vector<std::size_t> room(count_, capacity_);
    room[last] = points_.size() - (count_ - 1) * capacity_;

    struct Member {
      double distance2;
      std::uint32_t index;
    };
    std::vector<std::vector<Member>> members(count_);
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      const std::uint32_t c = cluster_of_[i];
      members[c].push_back({distance2(points_[i], centres_[c]), i});
    }
    std::vector<std::uint32_t> movers;
    for (std::size_t c = 0; c < count_; ++c) {
      std::sort(members[c].begin(), members[c].end(), [](const Member& a, const Member& b) {
        return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : a.index < b.index;
      });
      for (std::size_t k = room[c]; k < members[c].size(); ++k) {
        movers.push_back(members[c][k].index);
      }
      room[c] -= std::min(room[c], members[c].size());
    }
    for (const std::uint32_t i : movers) {
      const std::uint32_t c = nearest(points_[i], [&](std::size_t k) { return room[k] > 0; });
      cluster_of_[i] = c;
      --room[c];
    }
    members_.assign(count_, 0);
    for (const std::uint32_t c : cluster_of_) ++members_[c];
  }

  Clusters collect() const {
    Clusters clusters{std::vector<std::uint32_t>(points_.size()), {0}};
    for (const std::size_t size : members_) {
      clusters.begin.push_back(clusters.begin.back() + static_cast<std::uint32_t>(size));
    }
    std::vector<std::uint32_t> next = clusters.begin;
    for (std::uint32_t i = 0; i < points_.size(); ++i) clusters.order[next[cluster_of_[i]]++] = i;
    return clusters;
  }

  std::size_t capacity_, count_;
  std::vector<Vec3> points_, centres_;
  std::vector<std::uint32_t> cluster_of_;
  std::vector<std::size_t> members_;  ///< of each cluster
};

}  // namespace

Clusters cluster_by_k_means(std::span<const Extent> boxes, std::uint32_t capacity) {
  return KMeans(boxes, capacity).run();
}

}  // namespace navjit::bvh
