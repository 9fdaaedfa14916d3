#include "analysis/buckets.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/axis.hpp"

namespace navjit {
namespace {

struct Range {
  int first, last;
};

Range range_of(const Buckets& b, const Extent& box, int axis, double margin) {
  const auto index = [&](double x) {
    const double i = std::floor((x - b.origin[axis]) / b.width[axis]);
    return static_cast<int>(std::clamp(i, 0.0, static_cast<double>(b.count[axis] - 1)));
  };
  return {index(low(box, axis) - margin), index(high(box, axis) + margin)};
}

Buckets layout(const Extent& scene, const std::array<int, 3>& count) {
  Buckets b;
  b.count = count;
  for (int axis = 0; axis < 3; ++axis) {
    b.origin[axis] = low(scene, axis);
    b.width[axis] = (high(scene, axis) - low(scene, axis)) / count[axis];
  }
  return b;
}

/// Sum over boxes of the number of buckets each reaches into: the length of `members`.
double total_members(const Buckets& b, std::span<const Extent> boxes, double margin) {
  double total = 0;
  for (const Extent& box : boxes) {
    double cells = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const Range r = range_of(b, box, axis, margin);
      cells *= r.last - r.first + 1;
    }
    total += cells;
  }
  return total;
}

/// What a ray pays: the candidates of a bucket, and the walk from bucket to bucket. The
/// weights are guesses that served well, not yet fitted to measurements.
double cost(const Buckets& b, double members) {
  const double buckets =
      static_cast<double>(b.count[0]) * static_cast<double>(b.count[1]) * b.count[2];
  const double per_bucket = members / buckets;
  const int walk = b.count[0] + b.count[1] + b.count[2] - 3;
  return per_bucket + 0.02 * walk + 0.3 * ((b.count[0] > 1) + (b.count[1] > 1) + (b.count[2] > 1));
}

void fill(Buckets& b, std::span<const Extent> boxes, double margin) {
  const std::size_t buckets = static_cast<std::size_t>(b.count[0]) * b.count[1] * b.count[2];
  std::vector<std::vector<std::uint32_t>> lists(buckets);
  for (std::uint32_t k = 0; k < boxes.size(); ++k) {
    const Range x = range_of(b, boxes[k], 0, margin), y = range_of(b, boxes[k], 1, margin),
                z = range_of(b, boxes[k], 2, margin);
    for (int i = x.first; i <= x.last; ++i) {
      for (int j = y.first; j <= y.last; ++j) {
        for (int l = z.first; l <= z.last; ++l) {
          lists[(static_cast<std::size_t>(i) * b.count[1] + j) * b.count[2] + l].push_back(k);
        }
      }
    }
  }
  b.first.assign(1, 0);
  for (const auto& list : lists) {
    b.members.insert(b.members.end(), list.begin(), list.end());
    b.first.push_back(static_cast<std::uint32_t>(b.members.size()));
  }
}

}  // namespace

Buckets make_buckets(const Extent& scene, std::span<const Extent> boxes, double margin,
                     const BucketLimits& limits) {
  // Greedy: refine whichever axis lowers the cost most, until none does.
  std::array<int, 3> count{1, 1, 1};
  Buckets best = layout(scene, count);
  double best_cost = cost(best, total_members(best, boxes, margin));
  for (;;) {
    std::array<int, 3> chosen = count;
    double chosen_cost = best_cost;
    for (int axis = 0; axis < 3; ++axis) {
      // Any count up to a limit: grids want just their own pitch, not the next power of two.
      for (int n = count[axis] + 1; n <= std::min(limits.max_per_axis, 4 * count[axis] + 8); ++n) {
        std::array<int, 3> trial = count;
        trial[axis] = n;
        const double buckets =
            static_cast<double>(trial[0]) * static_cast<double>(trial[1]) * trial[2];
        if (buckets > static_cast<double>(limits.max_buckets)) break;
        const Buckets candidate = layout(scene, trial);
        const double members = total_members(candidate, boxes, margin);
        if (members > static_cast<double>(limits.max_members)) continue;
        const double trial_cost = cost(candidate, members);
        if (trial_cost < chosen_cost * (1 - 1e-9)) {
          chosen = trial;
          chosen_cost = trial_cost;
        }
      }
    }
    if (chosen == count) break;
    count = chosen;
    best_cost = chosen_cost;
  }
  Buckets result = layout(scene, count);
  fill(result, boxes, margin);
  return result;
}

double mean_candidates(const Buckets& buckets) {
  return buckets.size() == 0
             ? 0
             : static_cast<double>(buckets.members.size()) / static_cast<double>(buckets.size());
}

}  // namespace navjit
