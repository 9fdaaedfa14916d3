// Solids whose faces a line may cross more than twice, as it does a torus or a hyperboloid: each
// face gives up to two spans, and the solid is where all of its bodies and none of its holes are.
namespace navjit::kernels {

/// A function along a ray and its derivative.
template <class Real>
struct Sample {
  Real value, slope;
};

/// A zero of the increasing (`rising`) or decreasing function in [low, high], where f
/// gives value and derivative: Newton's iteration, halving the bracket where that is no help.
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
    // Rounding would make it go to and fro.
    if (t + step / 4 == t) return next;
    t = next;
  }
  return t;
}

/// The parts of a ray behind one face, in order along it.
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
/// Spans that were measured from `shift` along the ray.
template <class Real>
constexpr SpanPair<Real> moved_by(const SpanPair<Real>& pair, Real shift) {
  const Span<Real>&a = pair.first, &b = pair.second;
  return {{a.enter < 0 ? a.enter : a.enter + shift, a.leave + shift, a.until + shift},
          {b.enter < 0 ? b.enter : b.enter + shift, b.leave + shift, b.until + shift}};
}

/// Is `t` before the end of the span?
template <class Real>
constexpr bool ends_after(const Span<Real>& span, Real t) {
  return (span.enter < span.until) & (t < span.until);
}
/// Moves `t` on to where the body is; says whether it had to.
template <class Real>
constexpr bool reach_body(const SpanPair<Real>& body, Real& t) {
  const Span<Real>& span = ends_after(body.first, t) ? body.first : body.second;
  const Real to = ends_after(span, t) ? larger(span.enter, t) : infinity<Real>();
  const bool moved = to > t;
  t = to;
  return moved;
}

/// Path to where all bodies first are and no hole is; -1 if the start is in the solid.
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

/// The exit from a body that the start is known to be in, folded into `leave`.
template <class Real>
constexpr Real leave_body(const SpanPair<Real>& body, Real leave) {
  return starts_in(body) ? smaller(body.first.leave, leave) : Real(0);
}
/// The path until one of the spans of a hole is entered, folded into `leave`.
template <class Real>
constexpr Real leave_into_holes(const SpanPair<Real>& hole, Real leave) {
  return leave_into_hole(hole.second, leave_into_hole(hole.first, leave));
}

/// The span between two faces across z: that of clip_face for either, without a branch on where
/// the ray heads.
template <class Real>
Span<Real> slab_span(Real z_low, Real z_high, const Vec3<Real>& p, const Direction<Real>& v,
                     Real tol) {
  const Real over = p.z - z_high, under = z_low - p.z;
  if (is_along(v.z)) return larger(over, under) > tol ? no_span<Real>() : whole_ray<Real>();
  const bool down = v.z < 0;
  const Real before = down ? over : under, depth = down ? -under : -over, rate = absolute(v.z);
  return {before > tol ? before / rate : -infinity<Real>(), depth / rate, (depth - tol) / rate};
}
/// The exit through these faces, as leave_face of either.
template <class Real>
Real leave_ends(Real z_low, Real z_high, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  const Real over = p.z - z_high, under = z_low - p.z;
  if (is_along(v.z)) return larger(over, under) > tol ? Real(0) : infinity<Real>();
  const Real depth = v.z < 0 ? -under : -over;
  return depth <= tol ? Real(0) : depth / absolute(v.z);
}

/// How far along the ray to go before looking at a solid within |x| <= hx, |y| <= hy and
/// z_low <= z <= z_high: towards a box somewhat larger, so that no start on a face is moved.
/// Infinity if the ray misses the box.
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
