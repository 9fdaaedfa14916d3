// A tube about the z axis: radii rmin..rmax, half length hz, possibly cut to an azimuthal segment.
// It is a convex body (slab, outer cylinder, convex wedge) less up to two convex holes (inner
// cylinder, missing sector).
namespace navjit::kernels {

template <class Real>
struct Tube {
  Real rmin, rmax, hz;  ///< mm; rmin may be 0
  Wedge<Real> wedge;
};

/// Does a direction run along the z axis, within the limit that is_along sets for flat faces?
template <class Real>
constexpr bool is_along_axis(const Direction<Real>& v) {
  return is_along(v.x) & is_along(v.y);
}

/// The path to where a line that is not along the axis leaves the infinite cylinder of radius r. a,
/// b and r2 are v.v, p.v and p.p, in x and y only.
template <class Real>
[[gnu::always_inline]] inline Real cylinder_exit(Real r, const Vec3<Real>& p,
                                                 const Direction<Real>& v, Real a, Real b,
                                                 Real r2) {
  const Real cross = p.x * v.y - p.y * v.x;
  const Real discriminant = b == 0 ? a * (r * r - r2) : a * (r * r) - cross * cross;
  const Real root = square_root(larger(discriminant, Real(0)));
  return larger((root - b) / a, Real(0));
}

/// Does a direction head in from the surface? A tangent leaves a round surface, and so does a ray
/// that comes no deeper than the tolerance: nearly along the axis it would leave and enter for
/// ever.
template <class Real>
[[gnu::always_inline]] inline bool heads_into_cylinder(Real r, const Vec3<Real>& p,
                                                       const Direction<Real>& v, Real tol, Real a,
                                                       Real b) {
  if (is_along_axis(v)) return true;
  const Real cross = p.x * v.y - p.y * v.x, inner = larger(r - tol, Real(0));
  return (b <= 0) & (cross * cross < inner * inner * a);
}

/// Directional containment in the infinite cylinder of radius r.
template <class Real>
[[gnu::always_inline]] inline bool in_cylinder(Real r, const Vec3<Real>& p,
                                               const Direction<Real>& v, Real tol) {
  const Real r2 = p.x * p.x + p.y * p.y;
  const Real outer = r + tol, inner = r - tol;
  if (r2 > outer * outer) return false;
  if (r2 < inner * inner && inner > 0) return true;
  const Real a = v.x * v.x + v.y * v.y, b = p.x * v.x + p.y * v.y;
  return heads_into_cylinder(r, p, v, tol, a, b);
}

/// Exit from the infinite cylinder of radius r, for points known to be in it.
template <class Real>
[[gnu::always_inline]] inline Real leave_cylinder(Real r, const Vec3<Real>& p,
                                                  const Direction<Real>& v, Real tol) {
  const Real a = v.x * v.x + v.y * v.y, b = p.x * v.x + p.y * v.y;
  const Real r2 = p.x * p.x + p.y * p.y, inner = r - tol, outer = r + tol;
  if (is_along_axis(v)) return r2 > outer * outer ? Real(0) : infinity<Real>();
  const bool deep = r2 < inner * inner && inner > 0;
  if (!deep && !heads_into_cylinder(r, p, v, tol, a, b)) return Real(0);
  return cylinder_exit(r, p, v, a, b, r2);
}

/// The span of the infinite cylinder of radius r. The discriminant is computed from the moment of
/// the ray about the axis, which keeps the accuracy that |p|^2 - r^2 loses far away.
template <class Real>
[[gnu::always_inline]] inline Span<Real> cylinder_span(Real r, const Vec3<Real>& p,
                                                       const Direction<Real>& v, Real tol) {
  const Real outer = r + tol;
  if (p.x * p.x + p.y * p.y <= outer * outer) {
    if (!in_cylinder(r, p, v, tol)) return no_span<Real>();
    const Real leave = leave_cylinder(r, p, v, tol);
    return {-infinity<Real>(), leave, leave};
  }
  const Real b = p.x * v.x + p.y * v.y;
  if (!(b < 0) || is_along_axis(v)) return no_span<Real>();
  const Real a = v.x * v.x + v.y * v.y;
  const Real cross = p.x * v.y - p.y * v.x;
  const Real discriminant = a * (r * r) - cross * cross;
  if (!(discriminant > 0)) return no_span<Real>();
  const Real root = square_root(discriminant), inverse = Real(1) / a;
  const Real leave = (-b + root) * inverse;
  return {(-b - root) * inverse, leave, leave};
}

template <class Real>
Side inside(const Tube<Real>& s, const Vec3<Real>& p, Real tol) {
  Side side = worse(Side::inside, absolute(p.z) - s.hz, tol);
  const Real r = square_root(p.x * p.x + p.y * p.y);
  side = worse(side, r - s.rmax, tol);
  if (s.rmin > 0) side = worse(side, s.rmin - r, tol);
  if (s.wedge.kind != 0) side = worse(side, wedge_distance(s.wedge, p.x, p.y), tol);
  return side;
}

template <class Real>
bool contains(const Tube<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  if (beyond_face(absolute(p.z) - s.hz, p.z < 0 ? -v.z : v.z, tol)) return false;
  if (!in_cylinder(s.rmax, p, v, tol)) return false;
  if (s.rmin > 0 && in_cylinder(s.rmin, p, v, tol)) return false;
  return in_wedge(s.wedge, p, v, tol);
}

template <class Real>
Real distance_to_entry(const Tube<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                       Real tol) {
  Span<Real> body = cylinder_span(s.rmax, p, v, tol);
  clip_slab(body, s.hz, p.z, v.z, v.inverse_z, tol);
  if (!is_ahead(body)) return infinity<Real>();
  if (s.wedge.kind == 1) clip_to_wedge(s.wedge, p, v, tol, body);
  const Span<Real> bore = s.rmin > 0 ? cylinder_span(s.rmin, p, v, tol) : no_span<Real>();
  return first_entry(body, bore, gap_span(s.wedge, p, v, tol));
}
template <class Real>
Real distance_to_in(const Tube<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  const Real t = distance_to_entry(s, p, v, tol);
  return t < 0 ? distance_from_within(s, p, tol) : t;
}

template <class Real>
Real distance_to_out(const Tube<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  Real leave = leave_cylinder(s.rmax, p, v, tol);
  leave = leave_slab(s.hz, p.z, v.z, v.inverse_z, tol, leave);
  if (s.rmin > 0) leave = leave_into_hole(cylinder_span(s.rmin, p, v, tol), leave);
  return leave_wedge(s.wedge, p, v, tol, leave);
}

/// A ray that left into the bore or into a missing sector may come back. If the point is nearer to
/// the bore than to the outer face, it is not known which of the two the ray has left by.
inline bool is_left_for_good(const Tube<double>& s, const Vec3<double>& p, double tol) {
  if (s.rmin == 0) return s.wedge.kind != 2;
  const double middle = (s.rmin + s.rmax) / 2;
  return (s.wedge.kind == 0) & (s.rmax - s.rmin > 8 * tol) &
         (p.x * p.x + p.y * p.y > middle * middle);
}

template <class Real>
Real safety_to_in(const Tube<Real>& s, const Vec3<Real>& p) {
  const Real r = square_root(p.x * p.x + p.y * p.y);
  Real away = larger(absolute(p.z) - s.hz, Real(0));
  away = larger(r - s.rmax, away);
  if (s.rmin > 0) away = larger(s.rmin - r, away);
  if (s.wedge.kind != 0) away = larger(wedge_distance(s.wedge, p.x, p.y), away);
  return away;
}

template <class Real>
Real safety_to_out(const Tube<Real>& s, const Vec3<Real>& p) {
  const Real r = square_root(p.x * p.x + p.y * p.y);
  Real depth = smaller(s.hz - absolute(p.z), s.rmax - r);
  if (s.rmin > 0) depth = smaller(r - s.rmin, depth);
  if (s.wedge.kind != 0) depth = smaller(-wedge_distance(s.wedge, p.x, p.y), depth);
  return larger(depth, Real(0));
}

}  // namespace navjit::kernels

// Beside navigation.
namespace navjit::kernels {

/// Offers the outer and the inner cylinder of a tube, and its wedge.
template <class Real>
void offer_cylinders(NearestFace<Real>& best, Real rmin, Real rmax, const Wedge<Real>& w,
                     const Vec3<Real>& p) {
  const Radial<Real> r = radial_at(p);
  offer(best, r.rho - rmax, Vec3<Real>{r.x, r.y, 0});
  if (rmin > 0) offer(best, rmin - r.rho, Vec3<Real>{-r.x, -r.y, 0});
  offer_wedge(best, w, p);
}
template <class Real>
Vec3<Real> normal(const Tube<Real>& s, const Vec3<Real>& p, Real tol) {
  NearestFace<Real> best = no_face(tol);
  offer_ends(best, -s.hz, s.hz, p.z);
  offer_cylinders(best, s.rmin, s.rmax, s.wedge, p);
  return best.normal;
}

}  // namespace navjit::kernels
