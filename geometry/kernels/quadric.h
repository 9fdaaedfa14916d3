// Solids between two planes across z and behind quadrics: ellipsoids, elliptical tubes and cones,
// paraboloids, hyperbolic and twisted tubes.
namespace navjit::kernels {

/// The face a x^2 + b y^2 + c z^2 + d z + e = 0, where z is measured from `origin`. The value is
/// negative within.
template <class Real>
struct Quadric {
  Real a, b, c, d, e;
  Real origin;
};

/// The value of a face's equation along a ray: a t^2 + 2 b t + c. `gradient2` is the squared length
/// of the gradient at the start, and bend + sqrt(bend2) bounds the second derivative in any unit
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

/// Signed distance to the surface, in magnitude a lower bound on either side: the value cannot
/// reach zero sooner, even with the steepest gradient and the largest second derivative.
template <class Real>
Real form_distance(const QuadraticForm<Real>& q) {
  const Real size = absolute(q.c);
  if (!(size > 0)) return Real(0);
  const Real gradient = square_root(q.gradient2), bend = q.bend + square_root(q.bend2);
  return 2 * q.c / (gradient + square_root(gradient * gradient + 2 * (bend * size)));
}

/// Is the magnitude of form_distance above the tolerance? This needs no square root of gradient2,
/// because within the tolerance of the surface the value is at most
/// tol * gradient + bend * tol^2 / 2 in magnitude.
template <class Real>
[[gnu::always_inline]] inline bool is_off_surface(const QuadraticForm<Real>& q, Real tol) {
  const Real bend = q.bend2 > 0 ? q.bend + square_root(q.bend2) : q.bend;
  const Real without_bend = absolute(q.c) - bend * (tol * tol / 2);
  return without_bend > 0 && without_bend * without_bend > tol * tol * q.gradient2;
}

/// Whether a ray that heads out of a surface which bends away from it is in again within the
/// tolerance. That would be a step too short to move the point.
template <class Real>
bool comes_back(const QuadraticForm<Real>& q, Real tol) {
  return q.a < 0 && q.b > 0 &&
         square_root(larger(q.b * q.b - q.a * q.c, Real(0))) + q.b <= -tol * q.a;
}

/// Directional containment for points within the tolerance of the surface. A tangent is in if the
/// value decreases along it. A ray that comes no deeper than the tolerance leaves at once, and a
/// ray that would be in again within the tolerance does not leave. Otherwise rays nearly along the
/// surface would leave and enter for ever, by steps too short to change the coordinates that
/// decide.
template <class Real>
[[gnu::always_inline]] inline bool heads_into_form(const QuadraticForm<Real>& q, Real tol) {
  if (comes_back(q, tol)) return true;
  if (q.b > 0 || (q.b == 0 && q.a >= 0 && !(q.c < 0))) return false;
  if (!(q.a > 0)) return true;
  // The lowest value along the ray is -(b^2 - a c) / a. It must be below the value as deep as the
  // tolerance.
  const Real most = tol * q.a;
  const Real without_bend = q.b * q.b - q.a * q.c - most * (tol * q.bend);
  return without_bend > 0 && without_bend * without_bend > most * most * q.gradient2;
}
template <class Real>
[[gnu::always_inline]] inline bool in_form(const QuadraticForm<Real>& q, Real tol) {
  return is_off_surface(q, tol) ? q.c < 0 : heads_into_form(q, tol);
}

/// Whether the closed form of a crossing is less accurate than the rounding of the value at the
/// crossing allows, so that one Newton step (`polished`) pays. For an ellipsoid or an elliptical
/// tube that is examined from nearby it is not: there all terms are as small at the start as at the
/// crossing.
template <class Face, class Real>
[[gnu::always_inline]] inline bool needs_polish(const Face&, const QuadraticForm<Real>&) {
  return true;
}
template <class Real>
[[gnu::always_inline]] inline bool needs_polish(const Quadric<Real>& f,
                                                const QuadraticForm<Real>& q) {
  return !((f.c >= 0) & (f.d == 0) & (q.c <= -4 * f.e));
}

/// A crossing at `t` after one Newton step, which removes the rounding error of the closed form.
template <class Face, class Real>
Real polished(const Face& f, const Vec3<Real>& p, const Direction<Real>& v, Real t) {
  if (!(t < infinity<Real>())) return t;
  const QuadraticForm<Real> q = form_at(f, advance(p, v, t), v);
  const Real step = q.c / (2 * q.b), to = t - step;
  // Where the ray grazes the face, the closed form is as good.
  return (q.b != 0) & (to > 0) & (absolute(step) * 1024 * 1024 < to) ? to : t;
}
/// Polishing changes a path by less than this fraction of it.
template <class Real>
constexpr Real most_polish() {
  return Real(1) / 65536;
}

template <class Real>
Real form_root(const QuadraticForm<Real>& q) {
  return square_root(larger(q.b * q.b - q.a * q.c, Real(0)));
}
/// Whether a ray that starts behind the face comes out of it.
template <class Real>
bool comes_out(const QuadraticForm<Real>& q, Real tol) {
  // A surface that bends away from the ray is left only by heading out.
  return q.a > 0 || (q.b > 0 && q.b * q.b > q.a * q.c && !comes_back(q, tol));
}
/// The path to where such a ray comes out; `root` is form_root(q).
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
/// Whether a ray that starts before the face comes in, for a face that bends around what is behind
/// it (a > 0).
template <class Real>
bool comes_in(const QuadraticForm<Real>& q, Real tol) {
  // A ray that starts on the surface and does not head in only grazes the face.
  return q.b < 0 && q.b * q.b > q.a * q.c && is_off_surface(q, tol);
}

/// The parts of the ray behind the face `f`, where `q` is form_at(f, p, v).
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
    // A surface that bends away from the ray is met again.
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

/// The same for a face that the ray does not start behind. From far away the discriminant is a
/// difference of squares a million times as large, and a bore of 0.01 mm would be missed from 10 m
/// away. Then the face is examined from a point just before the ray comes to it.
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

/// The smaller of `leave` and the path to the exit through the face; 0 for a start that is not
/// behind the face.
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

/// The solid within `outer`, outside of `inner`, and between two planes.
template <class Real>
struct QuadricSolid {
  Real hx, hy;         ///< the solid is within |x| <= hx, |y| <= hy, mm
  Real z_low, z_high;  ///< faces across z
  Quadric<Real> outer, inner;
  int bored;  ///< 0 if there is no inner face
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

/// For a start before the outer face, which bends around the solid: the path to where the ray is
/// both behind that face and between the planes. `form` is the face's form at `q`, a point `shift`
/// along the ray. The result is 0 if the ray is there at once, and infinity if it never is.
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
  // Where the ray comes out of the face is polished only if that might decide.
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

/// The unit vector along a form's gradient. The `b` of form_at for a direction along an axis is
/// half the slope along that axis.
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
