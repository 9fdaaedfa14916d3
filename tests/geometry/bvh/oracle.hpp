// What a box tree must find, in extended precision and by plain definitions, and the checks of one
// query against that.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "geometry/bvh/box_tree.hpp"
#include "geometry/bvh/box_tree_traversal.hpp"
#include "tests/geometry/bvh/random_boxes.hpp"

namespace navjit::bvh::test {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// All methods with all clusterings.
inline std::vector<Structure> structures() {
  std::vector<Structure> result{{Method::linear}, {Method::wide_tree}};
  for (const Method method : {Method::two_level, Method::regular_tree}) {
    for (const Clustering clustering :
         {Clustering::surface, Clustering::k_means, Clustering::furthest}) {
      result.push_back({method, clustering});
    }
  }
  return result;
}

/// The structure's name, in the form that a test's name may have.
inline std::string name_of(const Structure& structure) {
  std::string name = to_string(structure);
  for (char& c : name) c = c == '-' || c == ':' ? '_' : c;
  return name;
}

/// Where a ray enters and leaves a box; empty unless enter <= leave.
struct Path {
  long double enter, leave;
  bool meets(double limit) const { return enter <= leave && leave >= 0 && enter <= limit; }
};

inline Path path_in(const Extent& box, const Vec3& p, const Direction& v, double margin = 0) {
  const double low[3] = {box.min.x, box.min.y, box.min.z};
  const double high[3] = {box.max.x, box.max.y, box.max.z};
  const double at[3] = {p.x, p.y, p.z}, along[3] = {v.x, v.y, v.z};
  Path path{0, infinity};
  for (int axis = 0; axis < 3; ++axis) {
    const long double below = static_cast<long double>(low[axis]) - margin - at[axis];
    const long double above = static_cast<long double>(high[axis]) + margin - at[axis];
    if (along[axis] == 0) {
      if (below > 0 || above < 0) return {1, -1};
      continue;
    }
    const long double a = below / along[axis], b = above / along[axis];
    path.enter = std::max(path.enter, std::min(a, b));
    path.leave = std::min(path.leave, std::max(a, b));
  }
  return path;
}

inline long double distance_of(const Extent& box, const Vec3& p) {
  const auto outside = [](double low, double high, double x) {
    return std::max({static_cast<long double>(low) - x, static_cast<long double>(x) - high, 0.0L});
  };
  const long double x = outside(box.min.x, box.max.x, p.x), y = outside(box.min.y, box.max.y, p.y),
                    z = outside(box.min.z, box.max.z, p.z);
  return std::sqrt(x * x + y * y + z * z);
}

inline double reach(const Extent& box, const Vec3& p) {
  double result = 0;
  for (const double x :
       {box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z, p.x, p.y, p.z}) {
    result = std::max(result, std::fabs(x));
  }
  return result;
}

/// How far a tree's rounding may widen a box, for points and boxes within `reach`.
inline double slack(double reach) { return reach * 0x1p-20 + 0x1p-98; }

inline Direction towards(const Vec3& from, const Vec3& to) {
  return normalised(to.x - from.x, to.y - from.y, to.z - from.z);
}

/// A corner of the box, or a point on an edge, on a face or within.
inline Vec3 target(Generator& generator, const Extent& box) {
  const auto choose = [&](double low, double high) {
    const std::size_t way = pick(generator, 3);
    return way == 0 ? low : way == 1 ? high : uniform(generator, low, high);
  };
  return {choose(box.min.x, box.max.x), choose(box.min.y, box.max.y), choose(box.min.z, box.max.z)};
}

/// Visits with a constant limit, and asserts the contract for one ray.
inline void check_ray(const BoxTree& tree, std::span<const Extent> boxes, const Vec3& p,
                      const Direction& v, double limit) {
  std::vector<int> visits(boxes.size());
  tree.along_ray(p, v, limit, [&](std::uint32_t i, double enter) {
    ++visits.at(i);
    const double margin = slack(reach(boxes[i], p));
    EXPECT_GE(enter, 0);
    EXPECT_LE(enter, limit);
    const Path path = path_in(boxes[i], p, v);
    if (path.meets(limit)) {
      EXPECT_LE(static_cast<long double>(enter), path.enter);
    }
    // Nothing is visited that is not close to being met.
    EXPECT_TRUE(path_in(boxes[i], p, v, margin).meets(limit + margin)) << "false hit of box " << i;
    return limit;
  });
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const bool met = path_in(boxes[i], p, v).meets(limit);
    EXPECT_LE(visits[i], 1);
    EXPECT_TRUE(visits[i] == 1 || !met) << "missed box " << i;
  }
}

inline void check_point(const BoxTree& tree, std::span<const Extent> boxes, const Vec3& p,
                        double radius) {
  std::vector<int> contained(boxes.size()), close(boxes.size());
  tree.containing(p, [&](std::uint32_t i) {
    ++contained.at(i);
    EXPECT_LE(distance_of(boxes[i], p), 2 * slack(reach(boxes[i], p)));
    return true;
  });
  tree.near(p, radius, [&](std::uint32_t i, double bound) {
    ++close.at(i);
    const long double distance = distance_of(boxes[i], p);
    EXPECT_LE(static_cast<long double>(bound), distance);
    EXPECT_GE(static_cast<long double>(bound), distance - 4 * slack(reach(boxes[i], p)));
    EXPECT_LT(bound, radius);
    return radius;
  });
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const long double distance = distance_of(boxes[i], p);
    EXPECT_EQ(contained[i] == 1, contained[i] != 0);
    EXPECT_TRUE(contained[i] == 1 || distance > 0) << "containing missed box " << i;
    EXPECT_LE(close[i], 1);
    EXPECT_TRUE(close[i] == 1 || distance >= radius) << "near missed box " << i;
  }
}

}  // namespace navjit::bvh::test
