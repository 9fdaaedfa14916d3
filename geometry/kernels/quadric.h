// Solids between two planes across z and behind quadrics: ellipsoids, elliptical tubes and cones,
// paraboloids, hyperbolic and twisted tubes.
namespace navjit::kernels {

/// a x^2 + b y^2 + c z^2 + d z + e < 0 within, with z from `origin`.
template <class Real>
struct Quadric {
  Real a, b, c, d, e;
  Real origin;
};

/// The quadric along a ray: a t^2 + 2 b t + c. `gradient2` is the square of the length of its
/// gradient at the start, and bend + sqrt(bend2) bounds its second derivative in any unit
/// direction.
template <class Real>
struct QuadraticForm {
  Real a, b, c;
  Real gradient2, bend, bend2;
};

template <class Real>
Real value_of(const Quadric<Real>& f, const Vec3<Real>& p) {
  const Real z = p.z - f.origin;
  return f.a * (p.x * p.x) + f.b * (p.y * p.y) + (f.c * z + f.d) * z + f.e;
}
template <class Real>
[[gnu::always_inline]] inline QuadraticForm<Real> form_at(const Quadric<Real>& f,
                                                          const Vec3<Real>& p,
                                                          const Direction<Real>& v) {
  const Real z = p.z - f.origin;
  const Real gx = f.a * p.x, gy = f.b * p.y, gz = f.c * z + f.d / 2;
  return {f.a * (v.x * v.x) + f.b * (v.y * v.y) + f.c * (v.z * v.z),
          gx * v.x + gy * v.y + gz * v.z,
          value_of(f, p),
          4 * (gx * gx + gy * gy + gz * gz),
          2 * larger(larger(absolute(f.a), absolute(f.b)), absolute(f.c)),
          Real(0)};
}

/// Signed distance to the surface, a lower bound on either side: how far one has to go for the
/// value to reach zero with the steepest gradient and the strongest bend.
template <class Real>
Real form_distance(const QuadraticForm<Real>& q) {
  const Real size = absolute(q.c);
  if (!(size > 0)) return Real(0);
  const Real gradient = square_root(q.gradient2), bend = q.bend + square_root(q.bend2);
  return 2 * q.c / (gradient + square_root(gradient * gradient + 2 * (bend * size)));
}

/// Is form_distance beyond the tolerance, on either side? Told without a root of the gradient: the
/// value at the tolerance's distance is what the steepest gradient and the strongest bend make of
/// that.
template <class Real>
[[gnu::always_inline]] inline bool is_off_surface(const QuadraticForm<Real>& q, Real tol) {
  const Real bend = q.bend2 > 0 ? q.bend + square_root(q.bend2) : q.bend;
  const Real without_bend = absolute(q.c) - bend * (tol * tol / 2);
  return without_bend > 0 && without_bend * without_bend > tol * tol * q.gradient2;
}

/// Whether a ray that heads out is in again within the tolerance, by a step too short to move the
/// point: where the surface bends away from it.
template <class Real>
bool comes_back(const QuadraticForm<Real>& q, Real tol) {
  return q.a < 0 && q.b > 0 &&
         square_root(larger(q.b * q.b - q.a * q.c, Real(0))) + q.b <= -tol * q.a;
}

/// Directional containment within the tolerance of the surface. A tangent goes where that bends;
/// what comes no deeper than the tolerance leaves at once, and what would be in again within it
/// does not leave: nearly along the surface rays would come and go for ever, by steps that do not
/// move what decides.
template <class Real>
[[gnu::always_inline]] inline bool heads_into_form(const QuadraticForm<Real>& q, Real tol) {
  if (comes_back(q, tol)) return true;
  if (q.b > 0 || (q.b == 0 && q.a >= 0 && !(q.c < 0))) return false;
  if (!(q.a > 0)) return true;
  // Where it is deepest the value is that much, by `a`, below 0.
  const Real most = tol * q.a;
  const Real without_bend = q.b * q.b - q.a * q.c - most * (tol * q.bend);
  return without_bend > 0 && without_bend * without_bend > most * most * q.gradient2;
}
template <class Real>
[[gnu::always_inline]] inline bool in_form(const QuadraticForm<Real>& q, Real tol) {
  return is_off_surface(q, tol) ? q.c < 0 : heads_into_form(q, tol);
}

/// Whether the closed form loses more than its value at the crossing has of rounding anyway: not
/// where it was looked at from near a face that bounds an ellipsoid or an elliptical tube, whose
/// terms are all as small there as at the crossing.
template <class Face, class Real>
[[gnu::always_inline]] inline bool needs_polish(const Face&, const QuadraticForm<Real>&) {
  return true;
}
template <class Real>
[[gnu::always_inline]] inline bool needs_polish(const Quadric<Real>& f,
                                                const QuadraticForm<Real>& q) {
  return !((f.c >= 0) & (f.d == 0) & (q.c <= -4 * f.e));
}

/// A crossing at `t` after one step of Newton's, which undoes the rounding of the closed form.
template <class Face, class Real>
Real polished(const Face& f, const Vec3<Real>& p, const Direction<Real>& v, Real t) {
  if (!(t < infinity<Real>())) return t;
  const QuadraticForm<Real> q = form_at(f, advance(p, v, t), v);
  const Real step = q.c / (2 * q.b), to = t - step;
  // Where the ray grazes, the closed form is as good.
  return (q.b != 0) & (to > 0) & (absolute(step) * 1024 * 1024 < to) ? to : t;
}
/// Polishing changes a path by less than this part of it.
template <class Real>
constexpr Real most_polish() {
  return Real(1) / 65536;
}

template <class Real>
Real form_root(const QuadraticForm<Real>& q) {
  return square_root(larger(q.b * q.b - q.a * q.c, Real(0)));
}
/// Whether a ray that is behind the face comes out ahead of it.
template <class Real>
bool comes_out(const QuadraticForm<Real>& q, Real tol) {
  // A surface that bends away is left, if at all, by heading out.
  return q.a > 0 || (q.b > 0 && q.b * q.b > q.a * q.c && !comes_back(q, tol));
}
/// Where such a ray does; `root` is that of the form.
template <class Face, class Real>
Real form_exit(const Face& f, const QuadraticForm<Real>& q, Real root, const Vec3<Real>& p,
               const Direction<Real>& v) {
  const Real h = q.b + root;
  // Without a branch on where the ray heads.
  const bool bends_around = q.a > 0, inwards = bends_around & (q.b < 0);
  const Real depth = bends_around ? larger(-q.c, Real(0)) : -q.c;
  const Real above = inwards ? root - q.b : depth, below = inwards ? q.a : h;
  const Real leave = bends_around & !(below > 0) ? Real(0) : above / below;
  return needs_polish(f, q) ? polished(f, p, v, leave) : leave;
}
/// Whether a ray from before a face that bends around what is behind it comes in.
template <class Real>
bool comes_in(const QuadraticForm<Real>& q, Real tol) {
  // On the surface: a graze that is not entered.
  return q.b < 0 && q.b * q.b > q.a * q.c && is_off_surface(q, tol);
}

/// The parts of the ray behind the face, of which `q` is the form.
template <class Face, class Real>
SpanPair<Real> form_spans(const Face& f, const QuadraticForm<Real>& q, const Vec3<Real>& p,
                          const Direction<Real>& v, Real tol) {
  const Real root = form_root(q), forever = infinity<Real>();
  const auto at = [&](Real t) { return needs_polish(f, q) ? polished(f, p, v, t) : t; };
  const auto to = [&](Real enter, Real exit) { return Span<Real>{at(enter), exit, exit}; };
  if (in_form(q, tol)) {
    if (!comes_out(q, tol)) return one_span(whole_ray<Real>());
    const Real exit = form_exit(f, q, root, p, v);
    const Span<Real> first{-forever, exit, exit};
    // What bends away is met again.
    return q.a < 0 ? SpanPair<Real>{first, to((q.b + root) / -q.a, forever)} : one_span(first);
  }
  if (q.a > 0) {
    if (!comes_in(q, tol)) return no_spans<Real>();
    const Real h = root - q.b;
    return one_span(to(q.c / h, at(h / q.a)));
  }
  if (q.b < 0) return one_span(to(q.c / (root - q.b), forever));
  return q.a < 0 ? one_span(to((q.b + root) / -q.a, forever)) : no_spans<Real>();
}
template <class Face, class Real>
SpanPair<Real> form_spans(const Face& f, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  return form_spans(f, form_at(f, p, v), p, v, tol);
}

/// The same for a face that the ray is not behind, and may be so far from that its discriminant is
/// a difference of squares a million times as large: a bore of 0.01 mm would be missed from 10 m
/// away. There it is looked at from just before the ray comes to it.
template <class Face, class Real>
SpanPair<Real> form_spans_ahead(const Face& f, const Vec3<Real>& p, const Direction<Real>& v,
                                Real tol) {
  const QuadraticForm<Real> q = form_at(f, p, v);
  const Real square = q.b * q.b;
  const bool is_far =
      (q.a > 0) & (q.b < 0) & (q.c > 0) & (absolute(square - q.a * q.c) < square * Real(0x1p-20)) &&
      is_off_surface(q, tol);
  if (!is_far) [[likely]]
    return form_spans(f, q, p, v, tol);
  const Real middle = -q.b / q.a;
  const QuadraticForm<Real> nearest = form_at(f, advance(p, v, middle), v);
  const Real half_chord = form_root(nearest) / nearest.a;
  if (!(half_chord > 0)) return no_spans<Real>();
  const Real shift = middle - 2 * half_chord - 4 * tol;
  if (!(shift > 0)) return form_spans(f, q, p, v, tol);
  return moved_by(form_spans(f, advance(p, v, shift), v, tol), shift);
}

/// The exit through the face, folded into `leave`, for points behind it.
template <class Face, class Real>
Real leave_form(const Face& f, const Vec3<Real>& p, const Direction<Real>& v, Real tol,
                Real leave) {
  const QuadraticForm<Real> q = form_at(f, p, v);
  if (!in_form(q, tol)) return Real(0);
  if (!comes_out(q, tol)) return leave;
  const Real exit = form_exit(f, q, form_root(q), p, v);
  return exit > 0 ? smaller(exit, leave) : Real(0);
}

template <class Face, class Real>
Real face_distance(const Face& f, const Vec3<Real>& p) {
  return form_distance(form_at(f, p, Direction<Real>{}));
}

/// Within `outer`, outside of `inner`, between two planes.
template <class Real>
struct QuadricSolid {
  Real hx, hy;         ///< the solid is within |x| <= hx, |y| <= hy, mm
  Real z_low, z_high;  ///< faces across z
  Quadric<Real> outer, inner;
  int bored;  ///< 0: there is no inner face
};

template <class Real>
Side inside(const QuadricSolid<Real>& s, const Vec3<Real>& p, Real tol) {
  Side side = worse(Side::inside, larger(p.z - s.z_high, s.z_low - p.z), tol);
  side = worse(side, face_distance(s.outer, p), tol);
  if (s.bored != 0) side = worse(side, -face_distance(s.inner, p), tol);
  return side;
}

template <class Real>
bool contains(const QuadricSolid<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
              Real tol) {
  if (beyond_face(p.z - s.z_high, v.z, tol) || beyond_face(s.z_low - p.z, -v.z, tol)) return false;
  if (!in_form(form_at(s.outer, p, v), tol)) return false;
  return s.bored == 0 || !in_form(form_at(s.inner, p, v), tol);
}

/// The path to where a ray from before a face that bends around the solid comes into that and
/// between the planes, the face being looked at from `q`, `shift` along the ray; 0 if that is at
/// once, infinity if it is nowhere.
template <class Real>
Real entry_through_bend(const QuadricSolid<Real>& s, const Span<Real>& slab,
                        const QuadraticForm<Real>& form, const Vec3<Real>& q,
                        const Direction<Real>& v, Real shift, Real tol) {
  if (!comes_in(form, tol)) return infinity<Real>();
  const Real h = form_root(form) - form.b, far = h / form.a;
  const bool to_be_polished = needs_polish(s.outer, form);
  const Real entry = form.c / h;
  const Real near = (to_be_polished ? polished(s.outer, q, v, entry) : entry) + shift;
  const Real t = larger(near, larger(slab.enter, Real(0)));
  if (!(t < slab.until)) return infinity<Real>();
  if (!to_be_polished) return t < far + shift ? t : infinity<Real>();
  // Where the ray comes out is polished only where that might decide.
  const Real before_exit = (shift + far * (1 - most_polish<Real>())) * (1 - Real(0x1p-50));
  return t < before_exit || t < polished(s.outer, q, v, far) + shift ? t : infinity<Real>();
}

template <class Real>
Real distance_to_in(const QuadricSolid<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                    Real tol) {
  const Real shift = approach(s.hx, s.hy, s.z_low, s.z_high, p, v);
  if (!(shift < infinity<Real>())) return infinity<Real>();
  const Vec3<Real> q = shift > 0 ? advance(p, v, shift) : p;
  const Span<Real> slab = slab_span(s.z_low, s.z_high, p, v, tol);
  const QuadraticForm<Real> outer = form_at(s.outer, q, v);
  Real t;
  if (s.bored == 0 && outer.a > 0 && !in_form(outer, tol)) {
    t = entry_through_bend(s, slab, outer, q, v, shift, tol);
    if (t > 0) return t;
  } else {
    const SpanPair<Real> body[] = {one_span(slab),
                                   moved_by(form_spans(s.outer, outer, q, v, tol), shift)};
    const SpanPair<Real> hole[] = {s.bored != 0 ? moved_by(form_spans(s.inner, q, v, tol), shift)
                                                : no_spans<Real>()};
    t = first_entry(body, hole);
    if (!(t < 0)) return t;
  }
  return distance_from_within(s, p, tol);
}

template <class Real>
Real distance_to_out(const QuadricSolid<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                     Real tol) {
  Real leave = leave_ends(s.z_low, s.z_high, p, v, tol);
  leave = leave_form(s.outer, p, v, tol, leave);
  return s.bored != 0 ? leave_into_holes(form_spans_ahead(s.inner, p, v, tol), leave) : leave;
}

template <class Real>
Real safety_to_in(const QuadricSolid<Real>& s, const Vec3<Real>& p) {
  Real away = larger(larger(p.z - s.z_high, s.z_low - p.z), Real(0));
  away = larger(face_distance(s.outer, p), away);
  if (s.bored != 0) away = larger(-face_distance(s.inner, p), away);
  return away;
}

template <class Real>
Real safety_to_out(const QuadricSolid<Real>& s, const Vec3<Real>& p) {
  Real depth = smaller(s.z_high - p.z, p.z - s.z_low);
  depth = smaller(-face_distance(s.outer, p), depth);
  if (s.bored != 0) depth = smaller(face_distance(s.inner, p), depth);
  return larger(depth, Real(0));
}

}  // namespace navjit::kernels

// Beside navigation.
namespace navjit::kernels {

/// The direction of a form's gradient: half of its slopes along the axes are what `form_at` gives.
template <class Face, class Real>
Vec3<Real> form_normal(const Face& f, const Vec3<Real>& p) {
  const Direction<Real> x{1, 0, 0, 0, 0, 0}, y{0, 1, 0, 0, 0, 0}, z{0, 0, 1, 0, 0, 0};
  return unit_vector(Vec3<Real>{form_at(f, p, x).b, form_at(f, p, y).b, form_at(f, p, z).b});
}
template <class Face, class Real>
void offer_form(NearestFace<Real>& best, const Face& f, bool hole, const Vec3<Real>& p) {
  const Real beyond = face_distance(f, p);
  const Vec3<Real> n = form_normal(f, p);
  offer(best, hole ? -beyond : beyond, hole ? turned_over(n) : n);
}
template <class Real>
Vec3<Real> normal(const QuadricSolid<Real>& s, const Vec3<Real>& p, Real tol) {
  NearestFace<Real> best = no_face(tol);
  offer_ends(best, s.z_low, s.z_high, p.z);
  offer_form(best, s.outer, false, p);
  if (s.bored != 0) offer_form(best, s.inner, true, p);
  return best.normal;
}

}  // namespace navjit::kernels
