// Normals of solids. normal(s, p, tol) is the outward unit normal at a point on the surface of a
// solid, in the solid's own frame (docs/normals.md). Normals are needed where a track is reflected
// or refracted, but not for navigation. Therefore each kernel has its normals below the line
// "// Beside navigation.", and generated code contains only the text above that line.
//
// The face that counts is the one that the point is furthest beyond, or, for a point within the
// solid, the nearest one. If several faces are equal in this to within the tolerance, it is the
// first in the order in which they are offered. So a point on an edge gets the same face whatever
// the last bit of its coordinates. On the axis a round face has no normal; there the x direction
// counts as radial.
namespace navjit::kernels {

/// The best of the faces that have been offered.
template <class Real>
struct NearestFace {
  Real beyond;  ///< signed distance of the point
  Vec3<Real> normal;
  Real tol;
};
template <class Real>
constexpr NearestFace<Real> no_face(Real tol) {
  return {-infinity<Real>(), {0, 0, 1}, tol};
}
template <class Real>
constexpr void offer(NearestFace<Real>& best, Real beyond, const Vec3<Real>& normal) {
  if (!(beyond > best.beyond + best.tol)) return;
  best.beyond = beyond;
  best.normal = normal;
}

/// The vector scaled to unit length; the unit vector along z if the vector is zero.
template <class Real>
Vec3<Real> unit_vector(const Vec3<Real>& v) {
  const Real most = larger(absolute(v.x), larger(absolute(v.y), absolute(v.z)));
  if (!(most > 0)) return {0, 0, 1};
  const Real x = v.x / most, y = v.y / most, z = v.z / most;
  const Real length = square_root(x * x + y * y + z * z);
  return {x / length, y / length, z / length};
}
template <class Real>
constexpr Vec3<Real> turned_over(const Vec3<Real>& v) {
  return {-v.x, -v.y, -v.z};
}

/// The unit vector away from the z axis at a point, and the distance of the point from the axis.
template <class Real>
struct Radial {
  Real x, y, rho;
};
template <class Real>
Radial<Real> radial_at(const Vec3<Real>& p) {
  const Real rho = square_root(p.x * p.x + p.y * p.y);
  if (!(rho > 0)) return {1, 0, rho};
  return {p.x / rho, p.y / rho, rho};
}
template <class Real>
constexpr void offer_ends(NearestFace<Real>& best, Real z_low, Real z_high, Real z) {
  offer(best, z - z_high, Vec3<Real>{0, 0, 1});
  offer(best, z_low - z, Vec3<Real>{0, 0, -1});
}

}  // namespace navjit::kernels
