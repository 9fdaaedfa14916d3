// Solids of flat faces that are convex by construction: parallelepipeds and tetrahedra.
#include <algorithm>

#include "geometry/solids/bodies.hpp"

namespace navjit {

Solid make_para(std::string name, double hx, double hy, double hz, double alpha, double theta,
                double phi) {
  return make_trap(std::move(name), hz, theta, phi, hy, hx, hx, alpha, hy, hx, hx, alpha);
}

Solid make_tet(std::string name, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 corners[4] = {a, b, c, d};
  Extent e{a, a};
  for (const Vec3& p : corners) {
    detail::require_finite({p.x, p.y, p.z}, name);
    e = merged(e, {p, p});
  }
  const double size = std::max({e.max.x - e.min.x, e.max.y - e.min.y, e.max.z - e.min.z});
  std::vector<kernels::Plane<double>> planes;
  for (int i = 0; i < 4; ++i) {
    const Vec3& opposite = corners[i];
    kernels::Plane<double> f =
        detail::plane_through(corners[(i + 1) % 4], corners[(i + 2) % 4], corners[(i + 3) % 4]);
    const double height = kernels::plane_distance(f, opposite);
    detail::require(std::abs(height) > 1e-10 * size && std::isfinite(height), name,
                    "the four corners of a tet must not be in one plane");
    if (height > 0) f = {0 - f.a, 0 - f.b, 0 - f.c, 0 - f.d};
    planes.push_back(f);
  }
  return detail::make_hull(std::move(name), std::move(planes), e);
}

}  // namespace navjit
