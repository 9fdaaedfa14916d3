// Two convex quadrilaterals across z with their corners joined by straight lines. The sides are
// flat or twisted: hyperbolic paraboloids, which a line may cross twice.
namespace navjit::kernels {

/// (a x + b y + c z + d) z + e x + f y + g < 0 within; a = b = c = 0 for a flat side.
template <class Real>
struct TwistedFace {
  Real a, b, c, d, e, f, g;
};

template <class Real>
struct Arb8 {
  Real hz;      ///< half length, mm
  Real hx, hy;  ///< the solid is within |x| <= hx, |y| <= hy, mm
  TwistedFace<Real> first, second, third, fourth;
};

template <class Real>
QuadraticForm<Real> form_at(const TwistedFace<Real>& s, const Vec3<Real>& p,
                            const Direction<Real>& v) {
  const Real across = s.a * p.x + s.b * p.y, rate = s.a * v.x + s.b * v.y + s.c * v.z;
  const Real gx = s.a * p.z + s.e, gy = s.b * p.z + s.f, gz = across + 2 * s.c * p.z + s.d;
  return {rate * v.z,
          (gx * v.x + gy * v.y + gz * v.z) / 2,
          (across + s.c * p.z + s.d) * p.z + s.e * p.x + s.f * p.y + s.g,
          gx * gx + gy * gy + gz * gz,
          absolute(s.c),
          s.a * s.a + s.b * s.b + s.c * s.c};
}

template <class Real>
Side inside(const Arb8<Real>& s, const Vec3<Real>& p, Real tol) {
  Side side = worse(Side::inside, absolute(p.z) - s.hz, tol);
  side = worse(side, face_distance(s.first, p), tol);
  side = worse(side, face_distance(s.second, p), tol);
  side = worse(side, face_distance(s.third, p), tol);
  return worse(side, face_distance(s.fourth, p), tol);
}

template <class Real>
bool contains(const Arb8<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  return !beyond_face(absolute(p.z) - s.hz, p.z < 0 ? -v.z : v.z, tol) &&
         in_form(form_at(s.first, p, v), tol) && in_form(form_at(s.second, p, v), tol) &&
         in_form(form_at(s.third, p, v), tol) && in_form(form_at(s.fourth, p, v), tol);
}

template <class Real>
Real distance_to_in(const Arb8<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  const Real shift = approach(s.hx, s.hy, -s.hz, s.hz, p, v);
  if (!(shift < infinity<Real>())) return infinity<Real>();
  const Vec3<Real> q = shift > 0 ? advance(p, v, shift) : p;
  const SpanPair<Real> body[] = {one_span(slab_span(-s.hz, s.hz, p, v, tol)),
                                 moved_by(form_spans(s.first, q, v, tol), shift),
                                 moved_by(form_spans(s.second, q, v, tol), shift),
                                 moved_by(form_spans(s.third, q, v, tol), shift),
                                 moved_by(form_spans(s.fourth, q, v, tol), shift)};
  const SpanPair<Real> hole[] = {no_spans<Real>()};
  const Real t = first_entry(body, hole);
  return t < 0 ? distance_from_within(s, p, tol) : t;
}

template <class Real>
Real distance_to_out(const Arb8<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  Real leave = leave_slab(s.hz, p.z, v.z, v.inverse_z, tol, infinity<Real>());
  leave = leave_form(s.first, p, v, tol, leave);
  leave = leave_form(s.second, p, v, tol, leave);
  leave = leave_form(s.third, p, v, tol, leave);
  return leave_form(s.fourth, p, v, tol, leave);
}

template <class Real>
Real beyond_arb8(const Arb8<Real>& s, const Vec3<Real>& p) {
  Real beyond = absolute(p.z) - s.hz;
  beyond = larger(face_distance(s.first, p), beyond);
  beyond = larger(face_distance(s.second, p), beyond);
  beyond = larger(face_distance(s.third, p), beyond);
  return larger(face_distance(s.fourth, p), beyond);
}
template <class Real>
Real safety_to_in(const Arb8<Real>& s, const Vec3<Real>& p) {
  return larger(beyond_arb8(s, p), Real(0));
}
template <class Real>
Real safety_to_out(const Arb8<Real>& s, const Vec3<Real>& p) {
  return larger(-beyond_arb8(s, p), Real(0));
}

}  // namespace navjit::kernels

// Beside navigation.
namespace navjit::kernels {

template <class Real>
Vec3<Real> normal(const Arb8<Real>& s, const Vec3<Real>& p, Real tol) {
  NearestFace<Real> best = no_face(tol);
  offer_ends(best, -s.hz, s.hz, p.z);
  offer_form(best, s.first, false, p);
  offer_form(best, s.second, false, p);
  offer_form(best, s.third, false, p);
  offer_form(best, s.fourth, false, p);
  return best.normal;
}

}  // namespace navjit::kernels
