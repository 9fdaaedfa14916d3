// Outward unit normals of placed, scaled and boolean solids: those of the operand whose surface the
// point is on, turned over for what is taken away.
namespace navjit::kernels {

template <class Real, class S>
Vec3<Real> normal(const Placed<Real, S>& s, const Vec3<Real>& p, Real tol) {
  const Vec3<Real> n = normal(s.solid, to_local(s, p), tol);
  if (s.rotated == 0) return n;
  const Real* r = s.rotation;
  // Rotations are orthonormal to 1e-6 only.
  return unit_vector(Vec3<Real>{r[0] * n.x + r[3] * n.y + r[6] * n.z,
                                r[1] * n.x + r[4] * n.y + r[7] * n.z,
                                r[2] * n.x + r[5] * n.y + r[8] * n.z});
}

/// The nearest face is that of the solid before it was stretched.
template <class Real, class S>
Vec3<Real> normal(const Scaled<Real, S>& s, const Vec3<Real>& p, Real tol) {
  const Vec3<Real> n = normal(s.solid, to_local(s, p), tol * s.most);
  return unit_vector(Vec3<Real>{s.inverse_x * n.x, s.inverse_y * n.y, s.inverse_z * n.z});
}

template <class Real, class S>
Vec3<Real> normal(const Boxed<Real, S>& s, const Vec3<Real>& p, Real tol) {
  return normal(s.solid, p, tol);
}

/// Outside by how much, or within (negative): by safeties, which may be less than the distances.
template <class Solid, class Real>
Real signed_safety(const Solid& s, const Vec3<Real>& p) {
  return safety_to_in(s, p) - safety_to_out(s, p);
}

/// On both surfaces, the first operand's normal holds unless it leads into the second, and then the
/// second's unless that leads into the first. If both do, the operands meet in a common face, and
/// the point is on its rim: what counts is the second's surface beside it.
template <class Real, class A, class B>
Vec3<Real> normal(const Union<A, B>& s, const Vec3<Real>& p, Real tol) {
  const bool on_a = inside(s.a, p, tol) == Side::surface;
  const bool on_b = inside(s.b, p, tol) == Side::surface;
  if (on_a && on_b) {
    const Vec3<Real> a = normal(s.a, p, tol), b = normal(s.b, p, tol);
    const Direction<Real> out = make_direction(a.x, a.y, a.z);
    if (!contains(s.b, p, out, tol)) return a;
    if (!contains(s.a, p, make_direction(b.x, b.y, b.z), tol)) return b;
    return normal(s.b, advance(p, out, 4 * tol), tol);
  }
  const bool first = on_a || (!on_b && signed_safety(s.a, p) <= signed_safety(s.b, p));
  return first ? normal(s.a, p, tol) : normal(s.b, p, tol);
}

template <class Real, class A, class B>
Vec3<Real> normal(const Intersection<A, B>& s, const Vec3<Real>& p, Real tol) {
  const bool on_a = inside(s.a, p, tol) == Side::surface;
  const bool on_b = inside(s.b, p, tol) == Side::surface;
  const bool first = on_a || (!on_b && signed_safety(s.a, p) >= signed_safety(s.b, p));
  return first ? normal(s.a, p, tol) : normal(s.b, p, tol);
}

template <class Real, class A, class B>
Vec3<Real> normal(const Subtraction<A, B>& s, const Vec3<Real>& p, Real tol) {
  const bool on_a = inside(s.a, p, tol) == Side::surface;
  const bool on_b = inside(s.b, p, tol) == Side::surface;
  const bool first = on_a || (!on_b && signed_safety(s.a, p) >= -signed_safety(s.b, p));
  return first ? normal(s.a, p, tol) : turned_over(normal(s.b, p, tol));
}

}  // namespace navjit::kernels
