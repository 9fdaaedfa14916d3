// A tube whose ends are cut off by planes in any direction.
namespace navjit::kernels {

template <class Real>
struct CutTube {
  Real rmin, rmax;        ///< mm; rmin may be 0
  Plane<Real> low, high;  ///< the ends; they do not meet within the tube
  Wedge<Real> wedge;
};

template <class Real>
Real ends_distance(const CutTube<Real>& s, const Vec3<Real>& p) {
  return larger(plane_distance(s.low, p), plane_distance(s.high, p));
}

template <class Real>
Side inside(const CutTube<Real>& s, const Vec3<Real>& p, Real tol) {
  Side side = worse(Side::inside, ends_distance(s, p), tol);
  const Real r = square_root(p.x * p.x + p.y * p.y);
  side = worse(side, r - s.rmax, tol);
  if (s.rmin > 0) side = worse(side, s.rmin - r, tol);
  if (s.wedge.kind != 0) side = worse(side, wedge_distance(s.wedge, p.x, p.y), tol);
  return side;
}

template <class Real>
bool contains(const CutTube<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  if (beyond_plane(s.low, p, v, tol) || beyond_plane(s.high, p, v, tol)) return false;
  if (!in_cylinder(s.rmax, p, v, tol)) return false;
  if (s.rmin > 0 && in_cylinder(s.rmin, p, v, tol)) return false;
  return in_wedge(s.wedge, p, v, tol);
}

template <class Real>
Real distance_to_in(const CutTube<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                    Real tol) {
  Span<Real> body = cylinder_span(s.rmax, p, v, tol);
  clip_plane(body, s.low, p, v, tol);
  clip_plane(body, s.high, p, v, tol);
  if (!is_ahead(body)) return infinity<Real>();
  if (s.wedge.kind == 1) clip_to_wedge(s.wedge, p, v, tol, body);
  const Span<Real> bore = s.rmin > 0 ? cylinder_span(s.rmin, p, v, tol) : no_span<Real>();
  const Real t = first_entry(body, bore, gap_span(s.wedge, p, v, tol));
  return t < 0 ? distance_from_within(s, p, tol) : t;
}

template <class Real>
Real distance_to_out(const CutTube<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                     Real tol) {
  Real leave = leave_cylinder(s.rmax, p, v, tol);
  leave = leave_plane(s.low, p, v, tol, leave);
  leave = leave_plane(s.high, p, v, tol, leave);
  if (s.rmin > 0) leave = leave_into_hole(cylinder_span(s.rmin, p, v, tol), leave);
  return leave_wedge(s.wedge, p, v, tol, leave);
}

template <class Real>
Real safety_to_in(const CutTube<Real>& s, const Vec3<Real>& p) {
  const Real r = square_root(p.x * p.x + p.y * p.y);
  Real away = larger(ends_distance(s, p), Real(0));
  away = larger(r - s.rmax, away);
  if (s.rmin > 0) away = larger(s.rmin - r, away);
  if (s.wedge.kind != 0) away = larger(wedge_distance(s.wedge, p.x, p.y), away);
  return away;
}

template <class Real>
Real safety_to_out(const CutTube<Real>& s, const Vec3<Real>& p) {
  const Real r = square_root(p.x * p.x + p.y * p.y);
  Real depth = smaller(-ends_distance(s, p), s.rmax - r);
  if (s.rmin > 0) depth = smaller(r - s.rmin, depth);
  if (s.wedge.kind != 0) depth = smaller(-wedge_distance(s.wedge, p.x, p.y), depth);
  return larger(depth, Real(0));
}

}  // namespace navjit::kernels

// Beside navigation.
namespace navjit::kernels {

template <class Real>
Vec3<Real> normal(const CutTube<Real>& s, const Vec3<Real>& p, Real tol) {
  NearestFace<Real> best = no_face(tol);
  offer_plane(best, s.high, p);
  offer_plane(best, s.low, p);
  offer_cylinders(best, s.rmin, s.rmax, s.wedge, p);
  return best.normal;
}

}  // namespace navjit::kernels
