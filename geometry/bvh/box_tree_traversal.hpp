// Traversals of a BoxTree, with Vc (geometry/bvh/group_tests.hpp).
#pragma once

#include <bit>

#include "geometry/bvh/box_tree.hpp"
#include "geometry/bvh/group_tests.hpp"
#include "geometry/bvh/rounding.hpp"
#include "geometry/bvh/wide_tree.hpp"

namespace navjit::bvh {
namespace detail {

/// A candidate as one number. Non-negative floats have the same order as their bits.
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

/// The groups that are still to be entered. There are at most 11 levels; each leaves 7 groups
/// behind, and 8 more come.
class DepthFirst {
 public:
  bool empty() const { return count_ == 0; }
  std::uint32_t size() const { return count_; }

  /// Keeps the entries from place `above` on in order: the nearest last, by number among equals.
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

/// A few candidates, taken out nearest first and by number among equals. To take one out looks at
/// all: most queries shrink their limit at once and need no complete order. Small and not
/// initialised: it is on the call stack of every query. Callers empty it in time.
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

/// Tests groups first ... last - 1. `number_of(group, lane)` gives the number of a candidate, or
/// no_box; `take(number, distance)` receives candidates nearest first, in batches of a few groups,
/// and returns the limit from there on. Returns the last limit.
template <class Test, class NumberOf, class Take>
double BoxTree::scan(std::uint32_t first, std::uint32_t last, const Test& test, double limit,
                     const NumberOf& number_of, const Take& take) const {
  detail::NearestFirst found;
  detail::Verdict verdict;
  float rounded_limit = float_above_point(limit);
  const auto take_found = [&] {
    while (!found.empty()) {
      const auto [distance, number] = found.take();
      if (!Test::within(distance, limit)) break;
      limit = take(number, distance);
    }
    found.clear();
    rounded_limit = float_above_point(limit);
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

/// Goes depth first, into the nearest lane of each group before the others.
template <class Test, class Visit>
void BoxTree::descend(const Test& test, double limit, const Visit& visit) const {
  if (groups_.empty()) return;
  detail::Verdict verdict;
  detail::DepthFirst open;
  detail::NearestFirst found;
  open.insert(0, 0, 0);
  float rounded_limit = float_above_point(limit);
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
    // Mostly the first box ends the search: it is cheaper to look for it than to sort.
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
    rounded_limit = float_above_point(limit);
  }
}

/// The same where lanes are boxes or groups. It keeps the groups on the way down to the present
/// one, each with those of its candidates that are still to be looked at.
template <class Test, class Visit>
void BoxTree::descend_wide(const Test& test, double limit, const Visit& visit) const {
  using detail::Candidates;
  if (groups_.empty()) return;
  struct Left {
    Candidates candidates;
    std::size_t group;
  };
  Left left[wide_tree_levels];
  alignas(32) float distances[wide_tree_levels][group_width];
  const BoxGroup* const groups = groups_.data();
  const std::uint32_t* const numbers = index_.data();
  unsigned depth = 0;
  std::size_t group = 0;
  Candidates candidates;
  float rounded_limit = float_above_point(limit);
  test(groups[0], rounded_limit, candidates, distances[0]);
  for (;;) {
    const std::uint32_t key = candidates.nearest();
    if (!Candidates::is_one(key) || !Test::within(Candidates::least_distance(key), limit)) {
      if (depth == 0) return;
      --depth;
      candidates = left[depth].candidates;
      group = left[depth].group;
      continue;
    }
    candidates.take_out(key);
    const std::uint32_t lane = Candidates::lane(key), number = numbers[group * group_width + lane];
    if ((number & is_group) != 0) {
      if (number == no_box) continue;  // infinitely far, within an infinite radius
      left[depth].candidates = candidates;
      left[depth].group = group;
      ++depth;
      group = number & ~is_group;
      test(groups[group], rounded_limit, candidates, distances[depth]);
      continue;
    }
    const double distance = distances[depth][lane];
    if (!Test::within(distance, limit)) continue;
    limit = visit(number, distance);
    rounded_limit = float_above_point(limit);
  }
}

template <class Test, class Visit>
void BoxTree::nearest_first(const Test& test, double limit, const Visit& visit) const {
  if (structure_.method == Method::wide_tree) return descend_wide(test, limit, visit);
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
  visit_overlapping(detail::OverlapTest(p), visit);
}

template <class Visit>
void BoxTree::overlapping(const Extent& box, Visit&& visit) const {
  visit_overlapping(detail::OverlapTest(box), visit);
}

template <class Test, class Visit>
void BoxTree::visit_overlapping(const Test& test, const Visit& visit) const {
  // Returns true if the search is to go on.
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
  if (structure_.method == Method::wide_tree) {
    if (groups_.empty()) return;
    std::uint32_t open[wide_tree_levels * group_width];
    unsigned count = 0;
    for (std::uint32_t group = 0;; group = open[--count]) {
      for (unsigned bits = test(groups_[group]); bits != 0; bits &= bits - 1) {
        const std::uint32_t number =
            index_of(group, static_cast<std::uint32_t>(std::countr_zero(bits)));
        if ((number & is_group) == 0) {
          if (!visit(number)) return;
        } else if (number != no_box) {
          open[count++] = number & ~is_group;
        }
      }
      if (count == 0) return;
    }
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
