// Solids of facets, closed or to be damaged, and an outline to be changed.
#pragma once

#include <array>
#include <cmath>

#include "geometry/solids/solid.hpp"
#include "navjit/vector.hpp"

namespace navjit::tests {

using Mesh = std::vector<FacetCorners>;

/// A ball of 10 mm with 8 * 4^`cuts` facets, dented so that it is not convex.
inline Mesh ball(int cuts = 3) {
  Mesh mesh;
  const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  for (const double sx : {1.0, -1.0}) {
    for (const double sy : {1.0, -1.0}) {
      for (const double sz : {1.0, -1.0}) {
        const bool even = sx * sy * sz > 0;
        mesh.push_back({sx * x, even ? sy * y : sz * z, even ? sz * z : sy * y});
      }
    }
  }
  for (int cut = 0; cut < cuts; ++cut) {
    Mesh finer;
    for (const FacetCorners& f : mesh) {
      const Vec3 a = 0.5 * (f[0] + f[1]), b = 0.5 * (f[1] + f[2]), c = 0.5 * (f[2] + f[0]);
      finer.insert(finer.end(), {{f[0], a, c}, {a, f[1], b}, {c, b, f[2]}, {a, b, c}});
    }
    mesh = std::move(finer);
  }
  for (FacetCorners& f : mesh) {
    for (Vec3& p : f) {
      p = (1 / norm(p)) * p;
      p = (10 - 4 * std::exp(-10 * ((p.x - 1) * (p.x - 1) + p.y * p.y))) * p;
    }
  }
  return mesh;
}
/// Twelve triangles.
inline Mesh block() {
  Mesh mesh;
  const auto corner = [](int i) {
    return Vec3{(i & 1) != 0 ? 5.0 : -5.0, (i & 2) != 0 ? 4.0 : -4.0, (i & 4) != 0 ? 3.0 : -3.0};
  };
  for (const auto& [a, b, c, d] : {std::array{0, 2, 3, 1},
                                   {4, 5, 7, 6},
                                   {0, 1, 5, 4},
                                   {2, 6, 7, 3},
                                   {0, 4, 6, 2},
                                   {1, 3, 7, 5}}) {
    mesh.push_back({corner(a), corner(b), corner(c)});
    mesh.push_back({corner(a), corner(c), corner(d)});
  }
  return mesh;
}
inline void flip(FacetCorners& f) { std::swap(f[1], f[2]); }

/// A comb of 30 corners, as a support is cut from a plate.
inline std::vector<PlanarPoint> comb() {
  std::vector<PlanarPoint> polygon;
  for (int i = 0; i < 7; ++i) {
    const double x = -10 + 3.0 * i;
    const std::vector<PlanarPoint> tooth{{x, -8}, {x + 1, -8}, {x + 1, 5}, {x + 3, 5}};
    polygon.insert(polygon.end(), tooth.begin(), tooth.end());
  }
  polygon.push_back({11, 8});
  polygon.push_back({-10, 8});
  return polygon;
}

}  // namespace navjit::tests
