// The boxes around triangles, whatever their arrangement.
#include "geometry/solids/facet_hierarchy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <random>

namespace navjit {
namespace {

using kernels::Facet;

struct Mesh {
  std::vector<Vec3> corners;
  std::vector<Facet> facets;

  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto first = static_cast<int>(corners.size());
    corners.insert(corners.end(), {a, b, c});
    facets.push_back({first, first + 1, first + 2});
  }
};

Mesh anywhere(int count) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> at(-1, 1);
  Mesh mesh;
  for (int i = 0; i < count; ++i) {
    const Vec3 p{100 * at(random), 100 * at(random), 10 * at(random)};
    mesh.add(p, p + Vec3{at(random), at(random), 0}, p + Vec3{0, at(random), at(random)});
  }
  return mesh;
}
/// Triangles, each twice as large as the one before: the best cut leaves one of them on its side.
Mesh doubling(int count) {
  Mesh mesh;
  for (int i = 0; i < count; ++i) {
    const double s = std::ldexp(1.0, i % 900 - 450);
    mesh.add({s, 0, 0}, {1.5 * s, s, 0}, {1.5 * s, 0, s});
  }
  return mesh;
}
Mesh one_place(int count) {
  Mesh mesh;
  for (int i = 0; i < count; ++i) mesh.add({1, 2, 3}, {4, 5, 6}, {7, 8, 10});
  return mesh;
}
Mesh along_a_line(int count) {
  Mesh mesh;
  for (int i = 0; i < count; ++i) {
    const double x = i;
    mesh.add({x, 0, 0}, {x + 1, 0, 0}, {x + 0.5, 0, 0});
  }
  return mesh;
}

/// Triangles so large that products of lengths, and sums of coordinates, are infinite.
Mesh huge(int count) {
  Mesh mesh = anywhere(count);
  for (Vec3& p : mesh.corners) p = {1.7e306 * p.x, 0.0, 1e306 * p.z};
  return mesh;
}

/// The most boxes on a way from the outermost box to a leaf.
int levels(const std::vector<kernels::FacetBox<double>>& boxes) {
  std::vector<int> ends;
  std::size_t most = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    while (!ends.empty() && ends.back() <= static_cast<int>(i)) ends.pop_back();
    ends.push_back(boxes[i].next);
    most = std::max(most, ends.size());
  }
  return static_cast<int>(most);
}

/// The most groups that wait at a time, where a ray meets all of them.
int waiting(const std::vector<kernels::FacetGroup<double>>& groups) {
  std::vector<int> open{0};
  std::size_t most = 0;
  while (!open.empty()) {
    const auto at = static_cast<std::size_t>(open.back());
    open.pop_back();
    int below[8];
    std::memcpy(below, &groups[at].below, sizeof below);
    for (const int next : below) {
      if (next > 0) open.push_back(next);
    }
    most = std::max(most, open.size());
  }
  return static_cast<int>(most);
}

using Corners = std::array<double, 9>;
Corners corners_of(const Mesh& mesh, const Facet& f) {
  Corners all;
  std::size_t at = 0;
  for (const int corner : {f.a, f.b, f.c}) {
    const Vec3& p = mesh.corners[static_cast<std::size_t>(corner)];
    for (const double x : {p.x, p.y, p.z}) all[at++] = x;
  }
  return all;
}

void expect_all_in_boxes(Mesh mesh) {
  std::map<Corners, int> given;
  for (const Facet& f : mesh.facets) ++given[corners_of(mesh, f)];
  const auto made = detail::build_facet_hierarchy(mesh.corners, mesh.facets);
  for (const Facet& f : mesh.facets) --given[corners_of(mesh, f)];
  for (const auto& [corners, count] : given) ASSERT_EQ(count, 0) << "the same facets, in order";

  EXPECT_LE(levels(made.boxes), kernels::most_facet_levels);
  EXPECT_LE(waiting(made.groups), kernels::most_waiting_groups);
  const auto count = static_cast<int>(mesh.facets.size());
  std::vector<int> held(mesh.facets.size(), 0);
  for (std::size_t i = 0; i < made.boxes.size(); ++i) {
    const kernels::FacetBox<double>& box = made.boxes[i];
    ASSERT_GT(box.next, static_cast<int>(i));
    for (int k = box.first; k < box.first + box.count; ++k) {
      ++held.at(static_cast<std::size_t>(k));
    }
    // All facets of boxes up to `next`, which have none if they are cut.
    for (int below = static_cast<int>(i); below < box.next; ++below) {
      const kernels::FacetBox<double>& inner = made.boxes[static_cast<std::size_t>(below)];
      for (int k = inner.first; k < inner.first + inner.count; ++k) {
        const Corners at = corners_of(mesh, mesh.facets[static_cast<std::size_t>(k)]);
        for (std::size_t c = 0; c < 9; c += 3) {
          ASSERT_TRUE(box.x_low <= at[c] && at[c] <= box.x_high && box.y_low <= at[c + 1] &&
                      at[c + 1] <= box.y_high && box.z_low <= at[c + 2] && at[c + 2] <= box.z_high);
        }
      }
    }
  }
  EXPECT_EQ(held, std::vector<int>(held.size(), 1));
  std::vector<int> firsts;
  for (const auto& leaf : made.leaves) firsts.push_back(leaf.first);
  std::sort(firsts.begin(), firsts.end());
  firsts.push_back(count);
  EXPECT_EQ(firsts[0], 0);
  for (std::size_t i = 1; i < firsts.size(); ++i) {
    EXPECT_TRUE(firsts[i] > firsts[i - 1] && firsts[i] <= firsts[i - 1] + 8);
  }
}

TEST(FacetHierarchy, HasAllFacetsInBoxes) {
  for (const int count : {1, 2, 4, 5, 8, 9, 64, 255, 256, 257, 1000, 5000}) {
    SCOPED_TRACE(count);
    expect_all_in_boxes(anywhere(count));
    expect_all_in_boxes(doubling(count));
    expect_all_in_boxes(one_place(count));
    expect_all_in_boxes(along_a_line(count));
    expect_all_in_boxes(huge(count));
  }
}

TEST(FacetHierarchy, KeepsApartWhatIsApart) {
  // Two clusters, of which one has many: cut between them, a box around the few holds no others.
  Mesh mesh = anywhere(400);
  const auto many = static_cast<int>(mesh.facets.size());
  for (int i = 0; i < 5; ++i) mesh.add({5000.0 + i, 0, 0}, {5001, 1, 0}, {5001, 0, 1});
  const auto made = detail::build_facet_hierarchy(mesh.corners, mesh.facets);
  const auto second = static_cast<std::size_t>(made.boxes[1].next);
  EXPECT_EQ(made.boxes[second].x_low, 5000);
  int few = 0;
  for (std::size_t i = second; i < made.boxes.size(); ++i) few += made.boxes[i].count;
  EXPECT_EQ(few, static_cast<int>(mesh.facets.size()) - many);
}

}  // namespace
}  // namespace navjit
