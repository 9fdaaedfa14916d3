// Eight boxes tested at once, with Vc: the slab test of a ray, the distance of a point, overlap.
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
#include <cstring>
#include <limits>

#include "geometry/bvh/box_tree.hpp"
#include "geometry/bvh/rounding.hpp"

namespace navjit::bvh::detail {

using Lanes = Vc::float_v;
static_assert(group_width % Lanes::Size == 0, "a group must be a whole number of SIMD vectors");

/// Per lane of a group: a lower bound of the distance, and whether the box is a candidate.
struct Verdict {
  alignas(64) float distance[group_width];
  unsigned candidates;  ///< one bit per lane
};

/// The candidates of a group that has been tested. Their nearest is found without a branch. Each
/// has a key: the bits of its distance, which have the same order as the distance, with the number
/// of the lane in place of the last three.
class Candidates {
 public:
  /// Sets one lane after the other; lanes where `mask` is false are no candidates.
  void set(unsigned lane, const Lanes::Mask& mask, const Lanes& distance) {
    Lanes masked(std::numeric_limits<float>::quiet_NaN());
    masked(mask) = distance;
    std::memcpy(reinterpret_cast<char*>(&keys_) + lane * sizeof(float), &masked, sizeof(masked));
    if (lane + Lanes::Size == group_width) {
      constexpr Keys lanes = {0, 1, 2, 3, 4, 5, 6, 7};
      keys_ = (keys_ & ~lane_bits) | lanes;
    }
  }
  /// The nearest candidate's key, or a key of none if there is no candidate.
  std::uint32_t nearest() const {
    Keys least = keys_;
    least = smaller(least, __builtin_shufflevector(least, least, 4, 5, 6, 7, 0, 1, 2, 3));
    least = smaller(least, __builtin_shufflevector(least, least, 2, 3, 0, 1, 6, 7, 4, 5));
    least = smaller(least, __builtin_shufflevector(least, least, 1, 0, 3, 2, 5, 4, 7, 6));
    return least[0];
  }
  void take_out(std::uint32_t key) { keys_ |= static_cast<Keys>(keys_ == key); }

  static bool is_one(std::uint32_t key) { return key < infinite + group_width; }
  /// A distance that is no more than the candidate's.
  static float least_distance(std::uint32_t key) { return std::bit_cast<float>(key & ~lane_bits); }
  static std::uint32_t lane(std::uint32_t key) { return key & lane_bits; }

 private:
  typedef std::uint32_t Keys __attribute__((vector_size(4 * group_width)));
  static constexpr std::uint32_t lane_bits = group_width - 1, infinite = 0x7f800000;
  static_assert(group_width == 8);

  static Keys smaller(const Keys& a, const Keys& b) { return a < b ? a : b; }

  Keys keys_;
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
      Lanes enter, leave;
      way_through(group, limit, lane, enter, leave);
      enter.store(verdict.distance + lane, Vc::Aligned);
      verdict.candidates |= static_cast<unsigned>((enter <= leave).toInt()) << lane;
    }
  }
  void operator()(const BoxGroup& group, float limit, Candidates& candidates,
                  float* distances) const {
    for (unsigned lane = 0; lane < group_width; lane += Lanes::Size) {
      Lanes enter, leave;
      way_through(group, limit, lane, enter, leave);
      enter.store(distances + lane, Vc::Aligned);
      candidates.set(lane, enter <= leave, enter);
    }
  }

 private:
  void way_through(const BoxGroup& group, float limit, unsigned lane, Lanes& enter,
                   Lanes& leave) const {
    enter = Lanes(Vc::Zero);
    leave = Lanes(limit);
    for (int axis = 0; axis < 3; ++axis) {
      const Lanes near_face(&group.bounds[near_row_[axis]][lane], Vc::Aligned);
      const Lanes far_face(&group.bounds[far_row_[axis]][lane], Vc::Aligned);
      enter = Vc::max((near_face - Lanes(near_origin_[axis])) * Lanes(near_inverse_[axis]), enter);
      leave = Vc::min((far_face - Lanes(far_origin_[axis])) * Lanes(far_inverse_[axis]), leave);
    }
  }
  void set(int axis, double p, double v, double inverse) {
    constexpr double margin = 0x1p-21, largest = 0x1p100;
    const bool down = v < 0;
    const float below = float_below_point(p), above = float_above_point(p);
    near_row_[axis] = down ? axis + 3 : axis;
    far_row_[axis] = down ? axis : axis + 3;
    near_origin_[axis] = down ? below : above;
    far_origin_[axis] = down ? above : below;
    near_inverse_[axis] = static_cast<float>(std::clamp(inverse * (1 - margin), -largest, largest));
    far_inverse_[axis] = static_cast<float>(inverse * (1 + margin));
  }

  float near_origin_[3], near_inverse_[3], far_origin_[3], far_inverse_[3];
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
      below_[axis] = Lanes(float_below_point(coordinate[axis]));
      above_[axis] = Lanes(float_above_point(coordinate[axis]));
    }
  }

  /// A box at exactly the radius cannot make it smaller.
  static bool within(double distance, double radius) { return distance < radius; }

  void operator()(const BoxGroup& group, float radius, Verdict& verdict) const {
    verdict.candidates = 0;
    for (unsigned lane = 0; lane < group_width; lane += Lanes::Size) {
      const Lanes distance = distance_to(group, lane);
      distance.store(verdict.distance + lane, Vc::Aligned);
      verdict.candidates |= static_cast<unsigned>((distance < Lanes(radius)).toInt()) << lane;
    }
  }
  void operator()(const BoxGroup& group, float radius, Candidates& candidates,
                  float* distances) const {
    for (unsigned lane = 0; lane < group_width; lane += Lanes::Size) {
      const Lanes distance = distance_to(group, lane);
      distance.store(distances + lane, Vc::Aligned);
      candidates.set(lane, distance < Lanes(radius), distance);
    }
  }

 private:
  Lanes distance_to(const BoxGroup& group, unsigned lane) const {
    Lanes square(Vc::Zero);
    for (int axis = 0; axis < 3; ++axis) {
      const Lanes low(&group.bounds[axis][lane], Vc::Aligned);
      const Lanes high(&group.bounds[axis + 3][lane], Vc::Aligned);
      const Lanes outside =
          Vc::max(Vc::max(low - above_[axis], below_[axis] - high), Lanes(Vc::Zero));
      square += outside * outside;
    }
    square = Vc::min(square, Lanes(std::numeric_limits<float>::max()));
    return Vc::sqrt(square) * Lanes(1 - 0x1p-21f);
  }
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

  explicit OverlapTest(const Vec3& p) {
    const double coordinate[3] = {p.x, p.y, p.z};
    for (int axis = 0; axis < 3; ++axis) {
      below_[axis] = Lanes(float_below_point(coordinate[axis]));
      above_[axis] = Lanes(float_above_point(coordinate[axis]));
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

}  // namespace navjit::bvh::detail
