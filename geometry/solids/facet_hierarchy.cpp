#include "geometry/solids/facet_hierarchy.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace navjit::detail {
namespace {

using kernels::Facet;

constexpr int facets_of_box = 4, facets_of_leaf = 8, lanes = 8;

struct Bounds {
  std::array<double, 3> low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};

  void add(const Bounds& other) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], other.low[i]);
      high[i] = std::max(high[i], other.high[i]);
    }
  }
  /// Half of the surface; nothing if there is no box.
  double surface() const {
    const double x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
    return x >= 0 ? x * y + y * z + z * x : 0;
  }
};

struct Item {
  Facet facet;
  Bounds bounds;

  /// Twice the coordinate of the box's centre along an axis.
  double place(std::size_t axis) const { return bounds.low[axis] + bounds.high[axis]; }
};

/// A part of the items, which follow one another. If it is cut, it has two parts below it.
struct Part {
  Bounds bounds;
  int first, count;
  int below[2];  ///< numbers of parts
  bool is_cut;
};

/// The best cut of a part so far; among equally good ones the most even.
struct Cut {
  double cost = INFINITY;
  int uneven = std::numeric_limits<int>::max();
  std::size_t axis = 0;
  std::size_t place = 0;  ///< that of the first item, or of the first slab, in the second half

  void offer(const Cut& other) {
    if (other.cost < cost || (other.cost == cost && other.uneven < uneven)) *this = other;
  }
};

double cost(const Bounds& bounds, int count) {
  return bounds.surface() * std::ceil(static_cast<double>(count) / facets_of_leaf);
}

class Builder {
 public:
  Builder(std::span<const Vec3> corners, const std::vector<Facet>& facets) {
    items_.reserve(facets.size());
    for (const Facet& f : facets) {
      Item item{f, {}};
      for (const int corner : {f.a, f.b, f.c}) {
        const Vec3& p = corners[static_cast<std::size_t>(corner)];
        item.bounds.add({{p.x, p.y, p.z}, {p.x, p.y, p.z}});
      }
      items_.push_back(item);
    }
    add(0, static_cast<int>(items_.size()), kernels::most_facet_levels - 1);
  }

  const std::vector<Item>& items() const { return items_; }
  /// The whole comes first, and each part comes before those that it is cut into.
  const std::vector<Part>& parts() const { return parts_; }

 private:
  std::span<Item> items_of(int first, int count) {
    return std::span(items_).subspan(static_cast<std::size_t>(first),
                                     static_cast<std::size_t>(count));
  }

  /// Adds a part with at most `levels` levels below it; returns its number.
  int add(int first, int count, int levels) {
    const auto number = static_cast<int>(parts_.size());
    Part part{{}, first, count, {0, 0}, count > facets_of_box};
    for (const Item& item : items_of(first, count)) part.bounds.add(item.bounds);
    parts_.push_back(part);
    if (part.is_cut) {
      // Halves the part if a cut with nearly all on one side might need too many levels.
      const bool any_cut = count - 1 <= std::int64_t{facets_of_box} << (levels - 1);
      const int here = any_cut ? best_cut(items_of(first, count)) : halve(items_of(first, count));
      part.below[0] = add(first, here, levels - 1);
      part.below[1] = add(first + here, count - here, levels - 1);
      parts_[static_cast<std::size_t>(number)] = part;
    }
    return number;
  }

  static void sort(std::span<Item> items, std::size_t axis) {
    std::stable_sort(items.begin(), items.end(), [axis](const Item& a, const Item& b) {
      return a.place(axis) < b.place(axis);
    });
  }

  /// Brings the items into order; returns how many come before the cut.
  static int best_cut(std::span<Item> items) {
    constexpr std::size_t few = 256;
    if (items.size() > few) {
      const int here = best_cut_between_slabs(items);
      return here > 0 ? here : halve(items);
    }
    Cut best;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sort(items, axis);
      std::array<double, few> before;
      Bounds bounds;
      for (std::size_t i = 1; i < items.size(); ++i) {
        bounds.add(items[i - 1].bounds);
        before[i] = cost(bounds, static_cast<int>(i));
      }
      bounds = {};
      for (std::size_t i = items.size() - 1; i > 0; --i) {
        bounds.add(items[i].bounds);
        const auto first = static_cast<int>(i), second = static_cast<int>(items.size()) - first;
        best.offer({before[i] + cost(bounds, second), std::abs(first - second), axis, i});
      }
    }
    if (best.place == 0) return halve(items);  // surfaces so large that they are no numbers
    sort(items, best.axis);
    return static_cast<int>(best.place);
  }

  /// As best_cut(); 0 if all items are in one place, or too far apart for slabs.
  static int best_cut_between_slabs(std::span<Item> items) {
    constexpr std::size_t slabs = 32;
    const auto slab_of = [](const Item& item, std::size_t axis, double from, double to) {
      const double at = (item.place(axis) - from) / (to - from) * slabs;
      return std::min(static_cast<std::size_t>(std::max(at, 0.0)), slabs - 1);
    };
    std::array<double, 3> from, to;
    Cut best;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto ends = std::minmax_element(
          items.begin(), items.end(),
          [axis](const Item& a, const Item& b) { return a.place(axis) < b.place(axis); });
      from[axis] = ends.first->place(axis);
      to[axis] = ends.second->place(axis);
      const double width = to[axis] - from[axis];
      if (!(width > 0 && width < INFINITY)) continue;
      struct Slab {
        Bounds bounds;
        int count = 0;
        void add(const Slab& other) {
          bounds.add(other.bounds);
          count += other.count;
        }
      };
      std::array<Slab, slabs> all, before;
      for (const Item& item : items) {
        all[slab_of(item, axis, from[axis], to[axis])].add({item.bounds, 1});
      }
      Slab sum;
      for (std::size_t i = 1; i < slabs; ++i) {
        sum.add(all[i - 1]);
        before[i] = sum;
      }
      sum = {};
      for (std::size_t i = slabs - 1; i > 0; --i) {
        sum.add(all[i]);
        if (before[i].count == 0 || sum.count == 0) continue;
        best.offer({cost(before[i].bounds, before[i].count) + cost(sum.bounds, sum.count),
                    std::abs(before[i].count - sum.count), axis, i});
      }
    }
    if (best.place == 0) return 0;
    const auto second = std::stable_partition(items.begin(), items.end(), [&](const Item& item) {
      return slab_of(item, best.axis, from[best.axis], to[best.axis]) < best.place;
    });
    return static_cast<int>(second - items.begin());
  }

  /// Cuts at the median along the longest side.
  static int halve(std::span<Item> items) {
    Bounds all;
    for (const Item& item : items) all.add(item.bounds);
    std::size_t longest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis) {
      if (all.high[axis] - all.low[axis] > all.high[longest] - all.low[longest]) longest = axis;
    }
    sort(items, longest);
    return static_cast<int>(items.size() / 2);
  }

  std::vector<Item> items_;
  std::vector<Part> parts_;
};

/// Eight numbers, which are set one by one.
template <class Number>
struct Eight {
  std::array<Number, lanes> at;

  explicit Eight(Number everywhere) { at.fill(everywhere); }
  kernels::EightOf<Number> all() const {
    return {at[0], at[1], at[2], at[3], at[4], at[5], at[6], at[7]};
  }
};

/// One corner of each item. Unused lanes repeat a corner of the first item, the same for all three.
kernels::EightCorners<double> corners_of(std::span<const Vec3> corners, std::span<const Item> items,
                                         int Facet::*which) {
  const Vec3& first = corners[static_cast<std::size_t>(items[0].facet.a)];
  Eight x(first.x), y(first.y), z(first.z);
  for (std::size_t i = 0; i < items.size(); ++i) {
    const Vec3& p = corners[static_cast<std::size_t>(items[i].facet.*which)];
    x.at[i] = p.x;
    y.at[i] = p.y;
    z.at[i] = p.z;
  }
  return {x.all(), y.all(), z.all()};
}

class Writer {
 public:
  Writer(std::span<const Vec3> corners, const Builder& built) : corners_(corners), built_(built) {
    add_boxes(0);
    add_group(0);
  }
  FacetHierarchy made;

 private:
  const Part& part(int number) const { return built_.parts()[static_cast<std::size_t>(number)]; }

  void add_boxes(int number) {
    const Part& p = part(number);
    const auto& [low, high] = p.bounds;
    const std::size_t at = made.boxes.size();
    made.boxes.push_back(
        {low[0], low[1], low[2], high[0], high[1], high[2], p.first, p.is_cut ? 0 : p.count, 0});
    if (p.is_cut) {
      for (const int below : p.below) add_boxes(below);
    }
    made.boxes[at].next = static_cast<int>(made.boxes.size());
  }

  /// Adds a leaf, as the lane of a group holds it.
  int add_leaf(const Part& p) {
    const auto items =
        std::span(built_.items())
            .subspan(static_cast<std::size_t>(p.first), static_cast<std::size_t>(p.count));
    kernels::FacetLeaf<double> leaf{corners_of(corners_, items, &Facet::a),
                                    corners_of(corners_, items, &Facet::b),
                                    corners_of(corners_, items, &Facet::c), p.first};
    made.leaves.push_back(leaf);
    return -static_cast<int>(made.leaves.size());
  }

  int add_group(int number) {
    const auto group = static_cast<int>(made.groups.size());
    made.groups.emplace_back();
    std::vector<int> below{number};
    const auto size = [this](int k) {
      return part(k).count > facets_of_leaf ? part(k).bounds.surface() : -1;
    };
    while (below.size() < lanes) {
      const auto largest = std::max_element(below.begin(), below.end(),
                                            [&](int a, int b) { return size(a) < size(b); });
      const Part& cut = part(*largest);
      if (cut.count <= facets_of_leaf) break;
      *largest = cut.below[0];
      below.push_back(cut.below[1]);
    }
    std::array<Eight<double>, 3> low{Eight<double>(INFINITY), Eight<double>(INFINITY),
                                     Eight<double>(INFINITY)};
    std::array<Eight<double>, 3> high{Eight<double>(-INFINITY), Eight<double>(-INFINITY),
                                      Eight<double>(-INFINITY)};
    Eight what(0);
    for (std::size_t lane = 0; lane < below.size(); ++lane) {
      const Part& p = part(below[lane]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis].at[lane] = p.bounds.low[axis];
        high[axis].at[lane] = p.bounds.high[axis];
      }
      what.at[lane] = p.count <= facets_of_leaf ? add_leaf(p) : add_group(below[lane]);
    }
    made.groups[static_cast<std::size_t>(group)] = {low[0].all(),  low[1].all(),  low[2].all(),
                                                    high[0].all(), high[1].all(), high[2].all(),
                                                    what.all()};
    return group;
  }

  std::span<const Vec3> corners_;
  const Builder& built_;
};

}  // namespace

FacetHierarchy build_facet_hierarchy(std::span<const Vec3> corners, std::vector<Facet>& facets) {
  const Builder built(corners, facets);
  for (std::size_t i = 0; i < facets.size(); ++i) facets[i] = built.items()[i].facet;
  return Writer(corners, built).made;
}

}  // namespace navjit::detail
