// A spherical shell about the origin, possibly cut to a range of azimuth and of polar angle. Each
// polar limit is a nappe with its tip at the centre. Either the solid lies within the nappe, or the
// nappe is a hole.
namespace navjit::kernels {

template <class Real>
struct PolarLimit {
  int kind;  ///< 0 none; 1 the solid is within the nappe; 2 the nappe is a hole
  ConicalFace<Real> face;
};

template <class Real>
struct Sphere {
  Real rmin, rmax;  ///< mm; rmin may be 0
  Wedge<Real> wedge;
  PolarLimit<Real> low, high;  ///< smallest and largest polar angle
};

/// Signed distance to the limit, positive beyond it; a lower bound of the distance on either side.
template <class Real>
Real polar_distance(const PolarLimit<Real>& limit, Real rho, Real z) {
  const Real s = cone_distance(limit.face, rho, z);
  return limit.kind == 1 ? s : -s;
}
template <class Real>
[[gnu::always_inline]] inline Span<Real> polar_span(const PolarLimit<Real>& limit,
                                                    const Vec3<Real>& p, const Direction<Real>& v,
                                                    Real tol, int kind) {
  return limit.kind == kind ? cone_span(limit.face, p, v, tol) : no_span<Real>();
}
template <class Real>
[[gnu::always_inline]] inline void clip_to_nappe(const PolarLimit<Real>& limit, const Vec3<Real>& p,
                                                 const Direction<Real>& v, Real tol, Real shift,
                                                 Span<Real>& body) {
  if (limit.kind != 1) return;
  const Span<Real> span = shifted(cone_span(limit.face, p, v, tol), shift);
  body.enter = larger(span.enter, body.enter);
  body.until = smaller(span.until, body.until);
}

template <class Real>
Side inside(const Sphere<Real>& s, const Vec3<Real>& p, Real tol) {
  const Real r = length(p), rho = square_root(p.x * p.x + p.y * p.y);
  Side side = worse(Side::inside, r - s.rmax, tol);
  if (s.rmin > 0) side = worse(side, s.rmin - r, tol);
  if (s.wedge.kind != 0) side = worse(side, wedge_distance(s.wedge, p.x, p.y), tol);
  if (s.low.kind != 0) side = worse(side, polar_distance(s.low, rho, p.z), tol);
  if (s.high.kind != 0) side = worse(side, polar_distance(s.high, rho, p.z), tol);
  return side;
}

template <class Real>
bool contains(const Sphere<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  if (!in_ball(s.rmax, p, v, tol)) return false;
  if (s.rmin > 0 && in_ball(s.rmin, p, v, tol)) return false;
  if (s.low.kind != 0 && in_cone(s.low.face, p, v, tol) != (s.low.kind == 1)) return false;
  if (s.high.kind != 0 && in_cone(s.high.face, p, v, tol) != (s.high.kind == 1)) return false;
  return in_wedge(s.wedge, p, v, tol);
}

template <class Real>
Real distance_to_in(const Sphere<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                    Real tol) {
  Span<Real> body = ball_span(s.rmax, p, v, tol);
  if (!is_ahead(body)) return infinity<Real>();
  // Spans of nappes are accurate for starts nearby, so they are taken from where the ray enters the
  // ball.
  const Real shift = larger(body.enter, Real(0));
  const Vec3<Real> q = advance(p, v, shift);
  clip_to_nappe(s.low, q, v, tol, shift, body);
  clip_to_nappe(s.high, q, v, tol, shift, body);
  if (s.wedge.kind == 1) clip_to_wedge(s.wedge, p, v, tol, body);
  if (!is_ahead(body)) return infinity<Real>();
  const Span<Real> bore = s.rmin > 0 ? ball_span(s.rmin, p, v, tol) : no_span<Real>();
  const Span<Real> gap = gap_span(s.wedge, p, v, tol);
  const Span<Real> low = shifted(polar_span(s.low, q, v, tol, 2), shift);
  const Span<Real> high = shifted(polar_span(s.high, q, v, tol, 2), shift);
  if (starts_in(body) && !starts_in(bore) && !starts_in(gap) && !starts_in(low) &&
      !starts_in(high)) {
    return distance_from_within(s, p, tol);
  }
  Real t = shift;
  t = larger(body.enter, t);
  for (bool moved = true; moved;) {
    moved = skip_hole(bore, t);
    moved |= skip_hole(gap, t);
    moved |= skip_hole(low, t);
    moved |= skip_hole(high, t);
  }
  return t < body.until ? t : infinity<Real>();
}

template <class Real>
[[gnu::always_inline]] inline Real leave_polar(const PolarLimit<Real>& limit, const Vec3<Real>& p,
                                               const Direction<Real>& v, Real tol, Real leave) {
  if (limit.kind == 0) return leave;
  if (limit.kind == 2) return leave_into_hole(cone_span(limit.face, p, v, tol), leave);
  return smaller(leave_cone(limit.face, p, v, tol), leave);
}

template <class Real>
Real distance_to_out(const Sphere<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                     Real tol) {
  Real leave = leave_ball(s.rmax, p, v, tol);
  if (s.rmin > 0) leave = leave_into_hole(ball_span(s.rmin, p, v, tol), leave);
  leave = leave_polar(s.low, p, v, tol, leave);
  leave = leave_polar(s.high, p, v, tol, leave);
  return leave_wedge(s.wedge, p, v, tol, leave);
}

template <class Real>
Real safety_to_in(const Sphere<Real>& s, const Vec3<Real>& p) {
  const Real r = length(p), rho = square_root(p.x * p.x + p.y * p.y);
  Real away = larger(r - s.rmax, Real(0));
  if (s.rmin > 0) away = larger(s.rmin - r, away);
  if (s.wedge.kind != 0) away = larger(wedge_distance(s.wedge, p.x, p.y), away);
  if (s.low.kind != 0) away = larger(polar_distance(s.low, rho, p.z), away);
  if (s.high.kind != 0) away = larger(polar_distance(s.high, rho, p.z), away);
  return away;
}

template <class Real>
Real safety_to_out(const Sphere<Real>& s, const Vec3<Real>& p) {
  const Real r = length(p), rho = square_root(p.x * p.x + p.y * p.y);
  Real depth = s.rmax - r;
  if (s.rmin > 0) depth = smaller(r - s.rmin, depth);
  if (s.wedge.kind != 0) depth = smaller(-wedge_distance(s.wedge, p.x, p.y), depth);
  if (s.low.kind != 0) depth = smaller(-polar_distance(s.low, rho, p.z), depth);
  if (s.high.kind != 0) depth = smaller(-polar_distance(s.high, rho, p.z), depth);
  return larger(depth, Real(0));
}

}  // namespace navjit::kernels

// Beside navigation.
namespace navjit::kernels {

template <class Real>
Vec3<Real> normal(const Sphere<Real>& s, const Vec3<Real>& p, Real tol) {
  const Radial<Real> r = radial_at(p);
  const Vec3<Real> away = unit_vector(p);
  NearestFace<Real> best = no_face(tol);
  offer(best, length(p) - s.rmax, away);
  if (s.rmin > 0) offer(best, s.rmin - length(p), turned_over(away));
  offer_wedge(best, s.wedge, p);
  for (const PolarLimit<Real>* limit : {&s.low, &s.high}) {
    if (limit->kind != 0) offer_nappe(best, limit->face, limit->kind == 2, p, r);
  }
  return best.normal;
}

}  // namespace navjit::kernels
