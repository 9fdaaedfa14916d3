// Traversals of a BoxTree with Vc.
//
// Why no hit is missed. Let u = 2^-24, the rounding unit of float. For a face b (a float, exact)
// and the true origin p (a double), the true path length to the face is T = (b - p) / v.
//  1. p is replaced by a float strictly beyond it: for the near face one that shortens the way, for
//     the far face one that lengthens it. The exact difference D to that float is thus on the safe
//     side of b - p, however large |p| is against the box: far points cost false hits, not misses.
//  2. fl(D) = D (1 + d), |d| <= u: a difference of floats cannot underflow, its sign is exact.
//  3. The product with a reciprocal r adds another factor (1 + d'). So fl(fl(D) r) is on the safe
//     side of T if r = (1/v) (1 - e) for the near, (1/v) (1 + e) for the far face, with e above
//     2u + u^2 for the two roundings, u for r's own and 2^-52 for the double division.
//     e = 8u leaves room. (Ize, "Robust BVH ray traversal", JCGT 2(2), 2013, scales the exit
//     distance per box instead; here the scale is free.) Where D is negative, so is the product:
//     the near face is then cut to 0, and a far face behind the origin is a true miss.
//  4. Direction components that are zero or tiny: r of the near face is cut to 2^100, which
//     shortens the way; r of the far face may become infinite, which lengthens it. 0 * inf = NaN
//     can occur at the far face alone, if D = 0: but the float of step 1 is *strictly* beyond p, so
//     D = 0 means that p is outside the slab and moves no nearer. Whatever the minimum makes of NaN
//     is right. As step 1 avoids subnormal floats, all this holds with flush-to-zero on, too.
//  5. The limit is rounded up. Comparisons are <=, so that ties are visited.
// A box at infinity passes because inf - p = inf; unused lanes (min = inf, max = -inf) have an
// infinite near and a negative far distance.
#pragma once

#include <Vc/Vc>
#include <algorithm>
#include <bit>
#include <limits>

#include "geometry/bvh/box_tree.hpp"
#include "geometry/bvh/rounding.hpp"

namespace navjit::bvh {
namespace detail {

using Lanes = Vc::float_v;
static_assert(group_width % Lanes::Size == 0, "a group must be a whole number of SIMD vectors");

/// Per lane of a group: a lower bound of the distance, and whether the box is a candidate.
struct Verdict {
  alignas(64) float distance[group_width];
  unsigned candidates;  ///< one bit per lane
};

/// The slab test of one ray.
class RayTest {
 public:
  RayTest(const Vec3& p, const Direction& v) {
    set(0, p.x, v.x, v.inverse_x);
    set(1, p.y, v.y, v.inverse_y);
    set(2, p.z, v.z, v.inverse_z);
  }

  /// A box met at exactly the limit counts.
  static bool within(double distance, double limit) { return distance <= limit; }

  void operator()(const BoxGroup& group, float limit, Verdict& verdict) const {
    verdict.candidates = 0;
    for (unsigned lane = 0; lane < group_width; lane += Lanes::Size) {
      Lanes enter(Vc::Zero), leave(limit);
      for (int axis = 0; axis < 3; ++axis) {
        const Lanes near_face(&group.bounds[near_row_[axis]][lane], Vc::Aligned);
        const Lanes far_face(&group.bounds[far_row_[axis]][lane], Vc::Aligned);
        enter = Vc::max((near_face - near_origin_[axis]) * near_inverse_[axis], enter);
        leave = Vc::min((far_face - far_origin_[axis]) * far_inverse_[axis], leave);
      }
      enter.store(verdict.distance + lane, Vc::Aligned);
      verdict.candidates |= static_cast<unsigned>((enter <= leave).toInt()) << lane;
    }
  }

 private:
  void set(int axis, double p, double v, double inverse) {
    constexpr double margin = 0x1p-21, largest = 0x1p100;
    const bool down = v < 0;
    const float below = float_below(p), above = float_above(p);
    near_row_[axis] = down ? axis + 3 : axis;
    far_row_[axis] = down ? axis : axis + 3;
    near_origin_[axis] = Lanes(down ? below : above);
    far_origin_[axis] = Lanes(down ? above : below);
    near_inverse_[axis] =
        Lanes(static_cast<float>(std::clamp(inverse * (1 - margin), -largest, largest)));
    far_inverse_[axis] = Lanes(static_cast<float>(inverse * (1 + margin)));
  }

  Lanes near_origin_[3], near_inverse_[3], far_origin_[3], far_inverse_[3];
  int near_row_[3], far_row_[3];
};

/// The distance of one point from boxes.
///
/// Along an axis the point is outside by max(min - p, p - max, 0), from floats that shorten it. The
/// square of the distance takes 1 rounding for each difference, squared, 1 for each square and 2
/// for the sums, all relative, as all terms are positive; where a square underflows, it is less.
/// The square root halves that and adds 1: 3.5 u in all, of which the factor 1 - 2^-21 = 1 - 8 u
/// takes care. Where the square overflows, the root of the largest float is still a lower bound.
class DistanceTest {
 public:
  explicit DistanceTest(const Vec3& p) {
    const double coordinate[3] = {p.x, p.y, p.z};
    for (int axis = 0; axis < 3; ++axis) {
      below_[axis] = Lanes(float_below(coordinate[axis]));
      above_[axis] = Lanes(float_above(coordinate[axis]));
    }
  }

  /// A box at exactly the radius cannot reduce it.
  static bool within(double distance, double radius) { return distance < radius; }

  void operator()(const BoxGroup& group, float radius, Verdict& verdict) const {
    verdict.candidates = 0;
    for (unsigned lane = 0; lane < group_width; lane += Lanes::Size) {
      Lanes square(Vc::Zero);
      for (int axis = 0; axis < 3; ++axis) {
        const Lanes low(&group.bounds[axis][lane], Vc::Aligned);
        const Lanes high(&group.bounds[axis + 3][lane], Vc::Aligned);
        const Lanes outside =
            Vc::max(Vc::max(low - above_[axis], below_[axis] - high), Lanes(Vc::Zero));
        square += outside * outside;
      }
      square = Vc::min(square, Lanes(std::numeric_limits<float>::max()));
      const Lanes distance = Vc::sqrt(square) * Lanes(1 - 0x1p-21f);
      distance.store(verdict.distance + lane, Vc::Aligned);
      verdict.candidates |= static_cast<unsigned>((distance < Lanes(radius)).toInt()) << lane;
    }
  }

 private:
  Lanes below_[3], above_[3];
};

/// Which boxes of a group meet a box, or contain a point: one bit per lane.
class OverlapTest {
 public:
  explicit OverlapTest(const Extent& box) {
    const double low[3] = {box.min.x, box.min.y, box.min.z};
    const double high[3] = {box.max.x, box.max.y, box.max.z};
    for (int axis = 0; axis < 3; ++axis) {
      below_[axis] = Lanes(float_below(low[axis]));
      above_[axis] = Lanes(float_above(high[axis]));
    }
  }

  unsigned operator()(const BoxGroup& group) const {
    unsigned candidates = 0;
    for (unsigned lane = 0; lane < group_width; lane += Lanes::Size) {
      Lanes::Mask within(true);
      for (int axis = 0; axis < 3; ++axis) {
        const Lanes low(&group.bounds[axis][lane], Vc::Aligned);
        const Lanes high(&group.bounds[axis + 3][lane], Vc::Aligned);
        within = within && low <= above_[axis] && high >= below_[axis];
      }
      candidates |= static_cast<unsigned>(within.toInt()) << lane;
    }
    return candidates;
  }

 private:
  Lanes below_[3], above_[3];
};

/// A candidate as one number: non-negative floats are ordered as their bits are.
struct Candidate {
  double distance;
  std::uint32_t number;

  static std::uint64_t key(float distance, std::uint32_t number) {
    return std::uint64_t{std::bit_cast<std::uint32_t>(distance + 0.0f)} << 32 | number;
  }
  static Candidate of(std::uint64_t key) {
    return {std::bit_cast<float>(static_cast<std::uint32_t>(key >> 32)),
            static_cast<std::uint32_t>(key)};
  }
};

/// The groups that are still to be entered. There are at most 11 levels; 7 stay for
/// each and 8 more come.
class DepthFirst {
 public:
  bool empty() const { return count_ == 0; }
  std::uint32_t size() const { return count_; }

  /// Keeps those from place `above` on in order, the nearest last; by number among equals.
  void insert(std::uint32_t above, float distance, std::uint32_t number) {
    const std::uint64_t key = Candidate::key(distance, number);
    std::uint32_t at = count_++;
    for (; at > above && keys_[at - 1] < key; --at) keys_[at] = keys_[at - 1];
    keys_[at] = key;
  }
  Candidate take() { return Candidate::of(keys_[--count_]); }

 private:
  static constexpr unsigned capacity = 96;
  std::uint64_t keys_[capacity];
  std::uint32_t count_ = 0;
};

/// A few candidates, taken out nearest first and by number among equals. Taking one out looks at
/// all: most queries shrink their limit at once and need no complete order. Kept small and not
/// initialised: it lives on the stack of every query. Those who fill it empty it in time.
class NearestFirst {
 public:
  bool has_room_for_a_group() const { return count_ + group_width <= capacity; }
  bool empty() const { return count_ == 0; }

  /// `distance` must not be negative.
  void insert(float distance, std::uint32_t number) {
    keys_[count_++] = Candidate::key(distance, number);
  }
  Candidate take() {
    unsigned best = 0;
    for (unsigned i = 1; i < count_; ++i) best = keys_[i] < keys_[best] ? i : best;
    const std::uint64_t key = keys_[best];
    keys_[best] = keys_[--count_];
    return Candidate::of(key);
  }
  void clear() { count_ = 0; }

 private:
  static constexpr unsigned capacity = 64;
  std::uint64_t keys_[capacity];
  unsigned count_ = 0;
};

}  // namespace detail

/// Tests groups first ... last - 1. `number_of(group, lane)` names a candidate, or is no_box;
/// `take(number, distance)` receives them nearest first, in batches of a few groups, and returns
/// the limit from there on. Returns the last limit.
template <class Test, class NumberOf, class Take>
double BoxTree::scan(std::uint32_t first, std::uint32_t last, const Test& test, double limit,
                     const NumberOf& number_of, const Take& take) const {
  detail::NearestFirst found;
  detail::Verdict verdict;
  float rounded_limit = float_above(limit);
  const auto take_found = [&] {
    while (!found.empty()) {
      const auto [distance, number] = found.take();
      if (!Test::within(distance, limit)) break;
      limit = take(number, distance);
    }
    found.clear();
    rounded_limit = float_above(limit);
  };
  for (std::uint32_t g = first; g < last; ++g) {
    test(groups_[g], rounded_limit, verdict);
    if (verdict.candidates == 0) continue;
    for (unsigned bits = verdict.candidates; bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(bits));
      const std::uint32_t number = number_of(g, lane);
      if (number != no_box) found.insert(verdict.distance[lane], number);
    }
    if (!found.has_room_for_a_group()) take_found();
  }
  take_found();
  return limit;
}

/// Depth first, the nearest lane of each group before the others.
template <class Test, class Visit>
void BoxTree::descend(const Test& test, double limit, const Visit& visit) const {
  if (groups_.empty()) return;
  detail::Verdict verdict;
  detail::DepthFirst open;
  detail::NearestFirst found;
  open.insert(0, 0, 0);
  float rounded_limit = float_above(limit);
  while (!open.empty()) {
    const auto [distance, group] = open.take();
    if (!Test::within(distance, limit)) continue;
    test(groups_[group], rounded_limit, verdict);
    if (group < parent_groups_) {
      const std::uint32_t above = open.size();
      const std::uint32_t first = first_group_[group], end = first_group_[group + 1];
      for (unsigned bits = verdict.candidates; bits != 0; bits &= bits - 1) {
        const auto lane = static_cast<std::uint32_t>(std::countr_zero(bits));
        if (first + lane < end) open.insert(above, verdict.distance[lane], first + lane);
      }
      continue;
    }
    // Mostly the first box ends the matter: cheaper to look for it than to sort.
    for (unsigned bits = verdict.candidates; bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(bits));
      const std::uint32_t number = index_of(group, lane);
      if (number != no_box) found.insert(verdict.distance[lane], number);
    }
    while (!found.empty()) {
      const auto box = found.take();
      if (!Test::within(box.distance, limit)) break;
      limit = visit(box.number, box.distance);
    }
    found.clear();
    rounded_limit = float_above(limit);
  }
}

template <class Test, class Visit>
void BoxTree::nearest_first(const Test& test, double limit, const Visit& visit) const {
  if (structure_.method == Method::regular_tree) return descend(test, limit, visit);
  const auto scan_children = [&](std::uint32_t first, std::uint32_t last, double from) {
    const auto box = [this](std::uint32_t g, std::uint32_t lane) { return index_of(g, lane); };
    return scan(first, last, test, from, box, visit);
  };
  if (structure_.method == Method::linear) {
    scan_children(0, static_cast<std::uint32_t>(groups_.size()), limit);
    return;
  }
  const auto cluster = [count = static_cast<std::uint32_t>(clusters())](std::uint32_t g,
                                                                        std::uint32_t lane) {
    const std::uint32_t number = g * group_width + lane;
    return number < count ? number : no_box;
  };
  scan(0, parent_groups_, test, limit, cluster, [&](std::uint32_t number, double) {
    return limit = scan_children(first_group_[number], first_group_[number + 1], limit);
  });
}

template <class Visit>
void BoxTree::along_ray(const Vec3& p, const Direction& v, double limit, Visit&& visit) const {
  nearest_first(detail::RayTest(p, v), limit, visit);
}

template <class Visit>
void BoxTree::near(const Vec3& p, double radius, Visit&& visit) const {
  nearest_first(detail::DistanceTest(p), radius, visit);
}

template <class Visit>
void BoxTree::containing(const Vec3& p, Visit&& visit) const {
  overlapping({p, p}, visit);
}

template <class Visit>
void BoxTree::overlapping(const Extent& box, Visit&& visit) const {
  const detail::OverlapTest test(box);
  // True to go on.
  const auto scan_children = [&](std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t g = first; g < last; ++g) {
      for (unsigned bits = test(groups_[g]); bits != 0; bits &= bits - 1) {
        const auto lane = static_cast<std::uint32_t>(std::countr_zero(bits));
        const std::uint32_t number = index_of(g, lane);
        if (number != no_box && !visit(number)) return false;
      }
    }
    return true;
  };
  if (structure_.method == Method::linear) {
    scan_children(0, static_cast<std::uint32_t>(groups_.size()));
    return;
  }
  if (structure_.method == Method::regular_tree) {
    if (groups_.empty()) return;
    std::uint32_t open[96];  // as in DepthFirst
    unsigned count = 0;
    for (std::uint32_t group = 0;; group = open[--count]) {
      if (group >= parent_groups_) {
        if (!scan_children(group, group + 1)) return;
      } else {
        for (unsigned bits = test(groups_[group]); bits != 0; bits &= bits - 1) {
          const std::uint32_t child =
              first_group_[group] + static_cast<std::uint32_t>(std::countr_zero(bits));
          if (child < first_group_[group + 1]) open[count++] = child;
        }
      }
      if (count == 0) return;
    }
  }
  const auto clusters = static_cast<std::uint32_t>(this->clusters());
  for (std::uint32_t g = 0; g < parent_groups_; ++g) {
    for (unsigned bits = test(groups_[g]); bits != 0; bits &= bits - 1) {
      const std::uint32_t cluster =
          g * group_width + static_cast<std::uint32_t>(std::countr_zero(bits));
      if (cluster < clusters && !scan_children(first_group_[cluster], first_group_[cluster + 1]))
        return;
    }
  }
}

}  // namespace navjit::bvh
