// The part of a ray inside a convex body, found face by face. Most solids are a convex body less a
// few convex holes, and their distances follow from the spans of these. Spans are intervals and
// need no check of hit points, so a ray through an edge is never lost.
//
// "Folded into `leave`" means here and in other kernels: the result is the smaller of `leave` and
// the path in question.
namespace navjit::kernels {

/// The part of a ray (path lengths from its start) in a convex body, in the directional sense of
/// `contains`: a start on a face that heads in is in, one that heads out is not.
template <class Real>
struct Span {
  Real enter;  ///< path to the crossing into the body; -infinity if the start is in
  Real leave;  ///< path to the crossing out of it
  Real until;  ///< the body can be entered before this path: `leave`, less the depth of tolerance
};

template <class Real>
constexpr Span<Real> whole_ray() {
  return {-infinity<Real>(), infinity<Real>(), infinity<Real>()};
}
template <class Real>
constexpr Span<Real> no_span() {
  return {infinity<Real>(), -infinity<Real>(), -infinity<Real>()};
}

/// Does the ray come through the body, or start in it?
template <class Real>
constexpr bool is_ahead(const Span<Real>& span) {
  return (span.enter < span.until) & (span.until > 0);
}
/// Is the start of the ray in the body?
template <class Real>
constexpr bool starts_in(const Span<Real>& span) {
  return (span.enter < 0) & (span.until > 0);
}

/// Clips a span to one flat face: `s` is the signed distance of the start beyond it, `nv` its
/// outward unit normal times the direction.
template <class Real>
constexpr void clip_face(Span<Real>& span, Real s, Real nv, Real tol) {
  if (is_along(nv)) {
    if (s > tol) span = no_span<Real>();
  } else if (nv < 0) {
    span.enter = s > tol ? larger(s / -nv, span.enter) : span.enter;
  } else {
    span.leave = smaller(-s / nv, span.leave);
    span.until = smaller((-s - tol) / nv, span.until);
  }
}

/// Clips a span to the slab |p| <= h of one axis.
template <class Real>
constexpr void clip_slab(Span<Real>& span, Real h, Real p, Real v, Real inverse, Real tol) {
  if (is_along(v)) {
    if (absolute(p) - h > tol) span = no_span<Real>();
    return;
  }
  const Real along = v < 0 ? -p : p, rate = absolute(inverse);
  const Real before = -h - along;
  span.enter = before > tol ? larger(before * rate, span.enter) : span.enter;
  span.leave = smaller((h - along) * rate, span.leave);
  span.until = smaller((h - tol - along) * rate, span.until);
}

/// The exit through one flat face, for a start known to be behind it, folded into `leave`: only a
/// direction that heads out crosses, at once if the start is on the face.
template <class Real>
constexpr Real leave_face(Real s, Real nv, Real tol, Real leave) {
  if (is_along(nv)) return s > tol ? Real(0) : leave;
  return nv < 0 ? leave : s >= -tol ? Real(0) : smaller(-s / nv, leave);
}
/// The exit from the slab |p| <= h of one axis.
template <class Real>
constexpr Real leave_slab(Real h, Real p, Real v, Real inverse, Real tol, Real leave) {
  if (is_along(v)) return absolute(p) - h > tol ? Real(0) : leave;
  const Real depth = h - (v < 0 ? -p : p);
  return depth <= tol ? Real(0) : smaller(depth * absolute(inverse), leave);
}

/// Moves `t` to the far side of a hole if it is in the hole; returns whether it was.
template <class Real>
constexpr bool skip_hole(const Span<Real>& hole, Real& t) {
  if (!((hole.enter <= t) & (t < hole.until))) return false;
  t = hole.leave;
  return true;
}

/// Path to the first crossing into a body with up to two holes; infinity if there is none, and -1
/// if the start is in the solid.
template <class Real>
constexpr Real first_entry(const Span<Real>& body, const Span<Real>& hole_a,
                           const Span<Real>& hole_b) {
  if (!is_ahead(body)) return infinity<Real>();
  if (starts_in(body) && !starts_in(hole_a) && !starts_in(hole_b)) return Real(-1);
  Real t = larger(body.enter, Real(0));
  // Leaving one hole may lead into the other.
  for (bool moved = true; moved;) {
    moved = skip_hole(hole_a, t);
    moved |= skip_hole(hole_b, t);
  }
  return t < body.until ? t : infinity<Real>();
}

/// The path until a hole is entered, for a start outside of the hole, folded into `leave`.
template <class Real>
constexpr Real leave_into_hole(const Span<Real>& hole, Real leave) {
  return is_ahead(hole) ? smaller(larger(hole.enter, Real(0)), leave) : leave;
}

/// The result of distance_to_in for a start that the solid contains: zero on the surface, otherwise
/// infinity.
template <class Real, class Solid>
Real distance_from_within(const Solid& s, const Vec3<Real>& p, Real tol) {
  return inside(s, p, tol) == Side::surface ? Real(0) : infinity<Real>();
}

}  // namespace navjit::kernels
