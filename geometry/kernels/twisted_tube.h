// A segment of a tube that is twisted about the z axis, so that lines along z become rulings of
// hyperboloids. Its round faces are hyperboloids, its sides are saddles, and its ends are flat.
namespace navjit::kernels {

/// The side that is a half-plane through the axis with outward normal n at z = 0, and is turned by
/// the angle whose tangent is kappa * z. The value n.p + kappa z (n x p) is negative within.
template <class Real>
struct Saddle {
  Real nx, ny;
  Real kappa;
};

template <class Real>
QuadraticForm<Real> form_at(const Saddle<Real>& f, const Vec3<Real>& p, const Direction<Real>& v) {
  const Real turn = f.kappa * p.z, rate = f.kappa * v.z;
  const Real side = f.ny * p.x - f.nx * p.y, side_rate = f.ny * v.x - f.nx * v.y;
  const Real gx = f.nx - turn * f.ny, gy = f.ny + turn * f.nx, gz = -f.kappa * side;
  return {-rate * side_rate,
          (gx * v.x + gy * v.y + gz * v.z) / 2,
          f.nx * p.x + f.ny * p.y - turn * side,
          gx * gx + gy * gy + gz * gz,
          absolute(f.kappa),
          Real(0)};
}

template <class Real>
struct TwistedTube {
  Real reach;          ///< no point is farther from the axis, mm
  Real z_low, z_high;  ///< faces across z
  Quadric<Real> outer, inner;
  Saddle<Real> start, end;
};

/// The largest of the signed distances to the faces; in magnitude a lower bound on either side.
template <class Real>
Real surface_distance(const TwistedTube<Real>& s, const Vec3<Real>& p) {
  Real d = larger(p.z - s.z_high, s.z_low - p.z);
  d = larger(face_distance(s.outer, p), d);
  d = larger(-face_distance(s.inner, p), d);
  d = larger(face_distance(s.start, p), d);
  return larger(face_distance(s.end, p), d);
}

template <class Real>
Side inside(const TwistedTube<Real>& s, const Vec3<Real>& p, Real tol) {
  return worse(Side::inside, surface_distance(s, p), tol);
}

template <class Real>
bool contains(const TwistedTube<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  if (beyond_face(p.z - s.z_high, v.z, tol) || beyond_face(s.z_low - p.z, -v.z, tol)) return false;
  return in_form(form_at(s.outer, p, v), tol) && !in_form(form_at(s.inner, p, v), tol) &&
         in_form(form_at(s.start, p, v), tol) && in_form(form_at(s.end, p, v), tol);
}

template <class Real>
Real distance_to_in(const TwistedTube<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                    Real tol) {
  const Real shift = approach(s.reach, s.reach, s.z_low, s.z_high, p, v);
  if (!(shift < infinity<Real>())) return infinity<Real>();
  const Vec3<Real> q = shift > 0 ? advance(p, v, shift) : p;
  const SpanPair<Real> body[] = {one_span(slab_span(s.z_low, s.z_high, p, v, tol)),
                                 moved_by(form_spans(s.outer, q, v, tol), shift),
                                 moved_by(form_spans(s.start, q, v, tol), shift),
                                 moved_by(form_spans(s.end, q, v, tol), shift)};
  const SpanPair<Real> hole[] = {moved_by(form_spans(s.inner, q, v, tol), shift)};
  const Real t = first_entry(body, hole);
  return t < 0 ? distance_from_within(s, p, tol) : t;
}

template <class Real>
Real distance_to_out(const TwistedTube<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                     Real tol) {
  Real leave = leave_face(p.z - s.z_high, v.z, tol, infinity<Real>());
  leave = smaller(leave_face(s.z_low - p.z, -v.z, tol, leave), leave);
  leave = leave_form(s.outer, p, v, tol, leave);
  leave = leave_form(s.start, p, v, tol, leave);
  leave = leave_form(s.end, p, v, tol, leave);
  return leave_into_holes(form_spans(s.inner, p, v, tol), leave);
}

template <class Real>
Real safety_to_in(const TwistedTube<Real>& s, const Vec3<Real>& p) {
  return larger(surface_distance(s, p), Real(0));
}
template <class Real>
Real safety_to_out(const TwistedTube<Real>& s, const Vec3<Real>& p) {
  return larger(-surface_distance(s, p), Real(0));
}

}  // namespace navjit::kernels

// Beside navigation.
namespace navjit::kernels {

template <class Real>
Vec3<Real> normal(const TwistedTube<Real>& s, const Vec3<Real>& p, Real tol) {
  NearestFace<Real> best = no_face(tol);
  offer_ends(best, s.z_low, s.z_high, p.z);
  offer_form(best, s.outer, false, p);
  offer_form(best, s.inner, true, p);
  offer_form(best, s.start, false, p);
  offer_form(best, s.end, false, p);
  return best.normal;
}

}  // namespace navjit::kernels
