// A ball centred on the origin; its functions also serve the shells of spheres.
namespace navjit::kernels {

template <class Real>
struct Orb {
  Real radius;  ///< mm
};

/// (v.v) r^2 - |p x v|^2. This discriminant is computed from the moment of the ray about the
/// centre, which keeps the accuracy far away. `a` is v.v.
template <class Real>
Real ball_discriminant(Real r, const Vec3<Real>& p, const Direction<Real>& v, Real a) {
  const Real mx = p.y * v.z - p.z * v.y, my = p.z * v.x - p.x * v.z, mz = p.x * v.y - p.y * v.x;
  return a * (r * r) - (mx * mx + my * my + mz * mz);
}

/// The path to where a line leaves the ball of radius r; b is p.v, and r2 is p.p.
template <class Real>
[[gnu::always_inline]] inline Real ball_exit(Real r, const Vec3<Real>& p, const Direction<Real>& v,
                                             Real b, Real r2) {
  const Real a = v.x * v.x + v.y * v.y + v.z * v.z;
  const Real discriminant = b == 0 ? a * (r * r - r2) : ball_discriminant(r, p, v, a);
  const Real root = square_root(larger(discriminant, Real(0)));
  return larger((root - b) / a, Real(0));
}

/// Does a direction head in from the surface? `b` is p.v. A tangent leaves a round surface, and so
/// does a ray that would come no deeper than the tolerance: by rounding it could leave and enter
/// again.
template <class Real>
[[gnu::always_inline]] inline bool heads_into_ball(Real r, const Vec3<Real>& p,
                                                   const Direction<Real>& v, Real tol, Real b) {
  const Real inner = larger(r - tol, Real(0)), a = v.x * v.x + v.y * v.y + v.z * v.z;
  return (b <= 0) & (ball_discriminant(inner, p, v, a) > 0);
}

/// Directional containment in the ball of radius r.
template <class Real>
[[gnu::always_inline]] inline bool in_ball(Real r, const Vec3<Real>& p, const Direction<Real>& v,
                                           Real tol) {
  const Real r2 = p.x * p.x + p.y * p.y + p.z * p.z;
  const Real outer = r + tol, inner = r - tol;
  if (r2 > outer * outer) return false;
  if (r2 < inner * inner && inner > 0) return true;
  return heads_into_ball(r, p, v, tol, p.x * v.x + p.y * v.y + p.z * v.z);
}

/// Exit from the ball of radius r, for points known to be in it.
template <class Real>
[[gnu::always_inline]] inline Real leave_ball(Real r, const Vec3<Real>& p, const Direction<Real>& v,
                                              Real tol) {
  const Real b = p.x * v.x + p.y * v.y + p.z * v.z;
  const Real r2 = p.x * p.x + p.y * p.y + p.z * p.z, inner = r - tol;
  const bool deep = r2 < inner * inner && inner > 0;
  if (!deep && !heads_into_ball(r, p, v, tol, b)) return Real(0);
  return ball_exit(r, p, v, b, r2);
}

template <class Real>
[[gnu::always_inline]] inline Span<Real> ball_span(Real r, const Vec3<Real>& p,
                                                   const Direction<Real>& v, Real tol) {
  const Real outer = r + tol;
  if (p.x * p.x + p.y * p.y + p.z * p.z <= outer * outer) {
    if (!in_ball(r, p, v, tol)) return no_span<Real>();
    const Real leave = leave_ball(r, p, v, tol);
    return {-infinity<Real>(), leave, leave};
  }
  const Real b = p.x * v.x + p.y * v.y + p.z * v.z;
  if (!(b < 0)) return no_span<Real>();
  const Real a = v.x * v.x + v.y * v.y + v.z * v.z;
  const Real discriminant = ball_discriminant(r, p, v, a);
  if (!(discriminant > 0)) return no_span<Real>();
  const Real root = square_root(discriminant), inverse = Real(1) / a;
  const Real leave = (-b + root) * inverse;
  return {(-b - root) * inverse, leave, leave};
}

template <class Real>
Real length(const Vec3<Real>& p) {
  return square_root(p.x * p.x + p.y * p.y + p.z * p.z);
}

template <class Real>
Side inside(const Orb<Real>& s, const Vec3<Real>& p, Real tol) {
  return worse(Side::inside, length(p) - s.radius, tol);
}
template <class Real>
bool contains(const Orb<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  return in_ball(s.radius, p, v, tol);
}
template <class Real>
Real distance_to_entry(const Orb<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                       Real tol) {
  const Span<Real> span = ball_span(s.radius, p, v, tol);
  if (!is_ahead(span)) return infinity<Real>();
  return span.enter >= 0 ? span.enter : Real(-1);
}
template <class Real>
Real distance_to_in(const Orb<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  const Real t = distance_to_entry(s, p, v, tol);
  return t < 0 ? distance_from_within(s, p, tol) : t;
}
template <class Real>
Real distance_to_out(const Orb<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  return leave_ball(s.radius, p, v, tol);
}
inline bool is_left_for_good(const Orb<double>&, const Vec3<double>&, double) { return true; }

template <class Real>
Real safety_to_in(const Orb<Real>& s, const Vec3<Real>& p) {
  return larger(length(p) - s.radius, Real(0));
}
template <class Real>
Real safety_to_out(const Orb<Real>& s, const Vec3<Real>& p) {
  return larger(s.radius - length(p), Real(0));
}

}  // namespace navjit::kernels

// Beside navigation.
namespace navjit::kernels {

template <class Real>
Vec3<Real> normal(const Orb<Real>&, const Vec3<Real>& p, Real) {
  return unit_vector(p);
}

}  // namespace navjit::kernels
