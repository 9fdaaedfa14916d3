// Solids whose faces a line may cross more than twice, as it may a torus or a hyperboloid. Each
// face gives up to two spans. The ray is in the solid where it is in all of the solid's bodies and
// in none of its holes.
namespace navjit::kernels {

/// The value of a function along a ray, and its derivative.
template <class Real>
struct Sample {
  Real value, slope;
};

/// A zero in [low, high] of a function that increases (`rising`) or decreases there; `f` gives its
/// value and derivative. Newton's iteration, with bisection where a Newton step does not help.
template <class Real, class F>
Real bracketed_zero(const F& f, Real low, Real high, bool rising) {
  Real t = low + (high - low) / 2, step = high - low;
  for (int i = 0; i < 400; ++i) {
    const Sample<Real> at = f(t);
    if (at.value == 0) return t;
    ((at.value < 0) == rising ? low : high) = t;
    Real next = t - at.value / at.slope;
    // Newton's step has to stay in the bracket and to be getting shorter.
    if (!(next >= low && next <= high) || absolute(next - t) > step / 2) {
      next = low + (high - low) / 2;
    }
    step = absolute(next - t);
    // From here on rounding would make the iteration go to and fro.
    if (t + step / 4 == t) return next;
    t = next;
  }
  return t;
}

/// The parts of a ray behind one face, in the order in which the ray comes to them.
template <class Real>
struct SpanPair {
  Span<Real> first, second;
};

template <class Real>
constexpr SpanPair<Real> one_span(const Span<Real>& span) {
  return {span, no_span<Real>()};
}
template <class Real>
constexpr SpanPair<Real> no_spans() {
  return {no_span<Real>(), no_span<Real>()};
}
template <class Real>
constexpr bool starts_in(const SpanPair<Real>& pair) {
  return starts_in(pair.first) | starts_in(pair.second);
}
/// Spans that were measured from `shift` along the ray, as measured from the ray's start.
template <class Real>
constexpr SpanPair<Real> moved_by(const SpanPair<Real>& pair, Real shift) {
  const Span<Real>&a = pair.first, &b = pair.second;
  return {{a.enter < 0 ? a.enter : a.enter + shift, a.leave + shift, a.until + shift},
          {b.enter < 0 ? b.enter : b.enter + shift, b.leave + shift, b.until + shift}};
}

/// Is `t` before the end of the span, and is there a span at all?
template <class Real>
constexpr bool ends_after(const Span<Real>& span, Real t) {
  return (span.enter < span.until) & (t < span.until);
}
/// Moves `t` ahead to where the ray is in the body, if it is not there, or to infinity; returns
/// whether `t` changed.
template <class Real>
constexpr bool reach_body(const SpanPair<Real>& body, Real& t) {
  const Span<Real>& span = ends_after(body.first, t) ? body.first : body.second;
  const Real to = ends_after(span, t) ? larger(span.enter, t) : infinity<Real>();
  const bool moved = to > t;
  t = to;
  return moved;
}

/// The path to where the ray is first in all bodies and in no hole; infinity if it never is, and -1
/// if the start is in the solid.
template <class Real, int bodies, int holes>
constexpr Real first_entry(const SpanPair<Real> (&body)[bodies],
                           const SpanPair<Real> (&hole)[holes]) {
  Real t = 0;
  bool waited = false;
  for (bool moved = true; moved;) {
    moved = false;
    for (const SpanPair<Real>& pair : body) moved |= reach_body(pair, t);
    if (!(t < infinity<Real>())) return infinity<Real>();
    for (const SpanPair<Real>& pair : hole) {
      moved |= skip_hole(pair.first, t);
      moved |= skip_hole(pair.second, t);
    }
    waited |= moved;
  }
  return waited ? t : Real(-1);
}

/// The smaller of `leave` and the path to the exit from a body that the start is known to be in.
template <class Real>
constexpr Real leave_body(const SpanPair<Real>& body, Real leave) {
  return starts_in(body) ? smaller(body.first.leave, leave) : Real(0);
}
/// The smaller of `leave` and the path to where the ray enters one of the spans of a hole.
template <class Real>
constexpr Real leave_into_holes(const SpanPair<Real>& hole, Real leave) {
  return leave_into_hole(hole.second, leave_into_hole(hole.first, leave));
}

/// The span between two planes across z, as clip_face of both planes gives it, but without a branch
/// on where the ray heads.
template <class Real>
Span<Real> slab_span(Real z_low, Real z_high, const Vec3<Real>& p, const Direction<Real>& v,
                     Real tol) {
  const Real over = p.z - z_high, under = z_low - p.z;
  if (is_along(v.z)) return larger(over, under) > tol ? no_span<Real>() : whole_ray<Real>();
  const bool down = v.z < 0;
  const Real before = down ? over : under, depth = down ? -under : -over, rate = absolute(v.z);
  return {before > tol ? before / rate : -infinity<Real>(), depth / rate, (depth - tol) / rate};
}
/// The exit through these planes, as leave_face of both gives it.
template <class Real>
Real leave_ends(Real z_low, Real z_high, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  const Real over = p.z - z_high, under = z_low - p.z;
  if (is_along(v.z)) return larger(over, under) > tol ? Real(0) : infinity<Real>();
  const Real depth = v.z < 0 ? -under : -over;
  return depth <= tol ? Real(0) : depth / absolute(v.z);
}

/// How far along the ray to go, mm, before examining a solid within |x| <= hx, |y| <= hy and z_low
/// <= z <= z_high, so that it is examined from nearby: to a box that is somewhat larger, so that a
/// start on a face is not moved. It is 0 from within this box, and infinity if the ray misses it.
template <class Real>
Real approach(Real hx, Real hy, Real z_low, Real z_high, const Vec3<Real>& p,
              const Direction<Real>& v) {
  const Real room = Real(1) / 64;
  const Real middle = (z_low + z_high) / 2, hz = (z_high - z_low) / 2;
  Span<Real> span = whole_ray<Real>();
  clip_slab(span, hx + room * hx, p.x, v.x, v.inverse_x, Real(0));
  clip_slab(span, hy + room * hy, p.y, v.y, v.inverse_y, Real(0));
  clip_slab(span, hz + room * hz, p.z - middle, v.z, v.inverse_z, Real(0));
  return is_ahead(span) ? larger(span.enter, Real(0)) : infinity<Real>();
}

}  // namespace navjit::kernels
