// Solids between two planes across z and behind quadrics: ellipsoids, elliptical tubes and cones,
// paraboloids, hyperbolic and twisted tubes.
namespace navjit::kernels {

/// a x^2 + b y^2 + c z^2 + d z + e < 0 within, with z from `origin`.
template <class Real>
struct Quadric {
  Real a, b, c, d, e;
  Real origin;
};

/// The quadric along a ray: a t^2 + 2 b t + c. `bend` bounds its second derivative in any unit
/// direction and `gradient` is the length of its gradient at the start.
template <class Real>
struct QuadraticForm {
  Real a, b, c;
  Real gradient, bend;
};

template <class Real>
Real value_of(const Quadric<Real>& f, const Vec3<Real>& p) {
  const Real z = p.z - f.origin;
  return f.a * (p.x * p.x) + f.b * (p.y * p.y) + (f.c * z + f.d) * z + f.e;
}
template <class Real>
QuadraticForm<Real> form_at(const Quadric<Real>& f, const Vec3<Real>& p, const Direction<Real>& v) {
  const Real z = p.z - f.origin;
  const Real gx = f.a * p.x, gy = f.b * p.y, gz = f.c * z + f.d / 2;
  return {f.a * (v.x * v.x) + f.b * (v.y * v.y) + f.c * (v.z * v.z), gx * v.x + gy * v.y + gz * v.z,
          value_of(f, p), 2 * square_root(gx * gx + gy * gy + gz * gz),
          2 * larger(larger(absolute(f.a), absolute(f.b)), absolute(f.c))};
}

/// Signed distance to the surface, a lower bound on either side: how far one has to go for the
/// value to reach zero with the steepest gradient and the strongest bend.
template <class Real>
Real form_distance(const QuadraticForm<Real>& q) {
  const Real size = absolute(q.c);
  if (!(size > 0)) return Real(0);
  return 2 * q.c / (q.gradient + square_root(q.gradient * q.gradient + 2 * (q.bend * size)));
}

/// Whether a ray that heads out is in again within the tolerance, by a step too short to move the
/// point: where the surface bends away from it.
template <class Real>
bool comes_back(const QuadraticForm<Real>& q, Real tol) {
  return q.a < 0 && q.b > 0 &&
         square_root(larger(q.b * q.b - q.a * q.c, Real(0))) + q.b <= -tol * q.a;
}

/// Directional containment. A tangent goes where the surface bends; what would be out again within
/// the tolerance, by a step too short to move the point, leaves at once, and what would be in again
/// does not leave.
template <class Real>
bool in_form(const QuadraticForm<Real>& q, Real tol) {
  const Real s = form_distance(q);
  if (s > tol) return false;
  if (s < -tol) return true;
  if (comes_back(q, tol)) return true;
  if (q.b > 0 || (q.b == 0 && q.a >= 0 && !(q.c < 0))) return false;
  if (!(q.a > 0) || q.b < -tol * q.a) return true;
  return square_root(larger(q.b * q.b - q.a * q.c, Real(0))) - q.b > tol * q.a;
}

/// A crossing at `t` after one step of Newton's, which undoes the rounding of the closed form.
template <class Face, class Real>
Real polished(const Face& f, const Vec3<Real>& p, const Direction<Real>& v, Real t) {
  if (!(t < infinity<Real>())) return t;
  const QuadraticForm<Real> q = form_at(f, advance(p, v, t), v);
  const Real step = q.c / (2 * q.b), to = t - step;
  // Where the ray grazes, the closed form is as good.
  return q.b != 0 && to > 0 && absolute(step) * 1024 * 1024 < to ? to : t;
}

/// The parts of the ray behind the face.
template <class Face, class Real>
SpanPair<Real> form_spans(const Face& f, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  const QuadraticForm<Real> q = form_at(f, p, v);
  const Real root = square_root(larger(q.b * q.b - q.a * q.c, Real(0)));
  const Real forever = infinity<Real>();
  const auto to = [&](Real enter, Real leave) {
    const Real entry = enter < 0 ? enter : polished(f, p, v, enter);
    const Real exit = polished(f, p, v, leave);
    return Span<Real>{entry, exit, exit};
  };
  if (in_form(q, tol)) {
    if (q.a > 0) {
      if (q.b < 0) return one_span(to(-forever, (root - q.b) / q.a));
      const Real h = q.b + root;
      return one_span(to(-forever, h > 0 ? larger(-q.c, Real(0)) / h : Real(0)));
    }
    // A surface that bends away is left, if at all, by heading out, and then met again.
    if (!(q.b > 0) || !(q.b * q.b > q.a * q.c) || comes_back(q, tol)) {
      return one_span(whole_ray<Real>());
    }
    const Real h = q.b + root;
    if (!(q.a < 0)) return one_span(to(-forever, -q.c / h));
    return {to(-forever, -q.c / h), to(h / -q.a, forever)};
  }
  if (q.a > 0) {
    // On the surface: a graze that is not entered.
    if (!(q.b < 0) || !(q.b * q.b > q.a * q.c) || form_distance(q) <= tol) return no_spans<Real>();
    const Real h = root - q.b;
    return one_span(to(q.c / h, h / q.a));
  }
  if (q.b < 0) return one_span(to(q.c / (root - q.b), forever));
  return q.a < 0 ? one_span(to((q.b + root) / -q.a, forever)) : no_spans<Real>();
}

/// The exit through the face, folded into `leave`, for points behind it.
template <class Face, class Real>
Real leave_form(const Face& f, const Vec3<Real>& p, const Direction<Real>& v, Real tol,
                Real leave) {
  return leave_body(form_spans(f, p, v, tol), leave);
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

template <class Real>
Real distance_to_in(const QuadricSolid<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                    Real tol) {
  const Real shift = approach(s.hx, s.hy, s.z_low, s.z_high, p, v);
  if (!(shift < infinity<Real>())) return infinity<Real>();
  const Vec3<Real> q = shift > 0 ? advance(p, v, shift) : p;
  const SpanPair<Real> body[] = {one_span(slab_span(s.z_low, s.z_high, p, v, tol)),
                                 moved_by(form_spans(s.outer, q, v, tol), shift)};
  const SpanPair<Real> hole[] = {s.bored != 0 ? moved_by(form_spans(s.inner, q, v, tol), shift)
                                              : no_spans<Real>()};
  const Real t = first_entry(body, hole);
  return t < 0 ? distance_from_within(s, p, tol) : t;
}

template <class Real>
Real distance_to_out(const QuadricSolid<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                     Real tol) {
  Real leave = leave_face(p.z - s.z_high, v.z, tol, infinity<Real>());
  leave = smaller(leave_face(s.z_low - p.z, -v.z, tol, leave), leave);
  leave = leave_form(s.outer, p, v, tol, leave);
  return s.bored != 0 ? leave_into_holes(form_spans(s.inner, p, v, tol), leave) : leave;
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
