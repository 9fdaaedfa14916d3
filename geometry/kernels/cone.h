// A cone about the z axis (a frustum with a conical bore), possibly cut to an azimuthal segment. It
// is a convex body (slab, outer nappe, convex wedge) less up to two convex holes (inner nappe,
// missing sector). The conical face also serves polycones and the polar faces of spheres.
namespace navjit::kernels {

/// One nappe of a cone about the z axis, scaled so that its signed distance is
/// cosine * rho - slope * z - radius, with cosine^2 + slope^2 = 1 and cosine >= 0. A cylinder has
/// slope 0; a plane across the axis has cosine 0.
template <class Real>
struct ConicalFace {
  Real radius, slope, cosine;
};

/// The face seen from a ray, in coordinates where it is a cone of 45 degrees: x^2 + y^2 = radius^2.
/// Along the ray x, y and radius change at the rates vx, vy and `rate`. The quadratic is
/// a t^2 + 2 b t + c, where r2 = x^2 + y^2 and c = r2 - radius^2.
template <class Real>
struct ConicalForm {
  Real x, y, radius, vx, vy, rate;
  Real r2, a, b;
};
template <class Real>
[[gnu::always_inline]] inline ConicalForm<Real> conical_form(const ConicalFace<Real>& f,
                                                             const Vec3<Real>& p,
                                                             const Direction<Real>& v) {
  const Real x = f.cosine * p.x, y = f.cosine * p.y, radius = f.radius + f.slope * p.z;
  const Real vx = f.cosine * v.x, vy = f.cosine * v.y, rate = f.slope * v.z;
  return {x,
          y,
          radius,
          vx,
          vy,
          rate,
          x * x + y * y,
          vx * vx + vy * vy - rate * rate,
          x * vx + y * vy - radius * rate};
}

/// The discriminant b^2 - a c, written without squares of large terms.
template <class Real>
[[gnu::always_inline]] inline Real conical_discriminant(const ConicalForm<Real>& q) {
  const Real gx = q.radius * q.vx - q.rate * q.x, gy = q.radius * q.vy - q.rate * q.y;
  const Real cross = q.x * q.vy - q.y * q.vx;
  return gx * gx + gy * gy - cross * cross;
}

/// Does the direction, which is steeper than the face, stay in the nappe for ever once it is in?
template <class Real>
[[gnu::always_inline]] inline bool stays_in_nappe(const ConicalForm<Real>& q) {
  return q.a < 0 && q.rate > 0;
}

/// Does the direction run along the whole face? The face is then a cylinder or a plane across the
/// axis.
template <class Real>
[[gnu::always_inline]] inline bool is_along_nappe(const ConicalForm<Real>& q) {
  return is_along(q.vx) & is_along(q.vy) & is_along(q.rate);
}

/// A path to where a ray leaves the nappe, or to the tip if that is nearer: nothing of the nappe is
/// beyond. For a ray along the face the path itself may be nothing but rounding errors.
template <class Real>
[[gnu::always_inline]] inline Real not_after_tip(const ConicalForm<Real>& q, Real leave) {
  const bool is_beyond = (q.rate < 0) & (leave * -q.rate > q.radius);
  return __builtin_expect(is_beyond, 0) ? larger(q.radius, Real(0)) / -q.rate : leave;
}
/// Likewise a path to where a ray enters the nappe, or to the tip if that is farther.
template <class Real>
[[gnu::always_inline]] inline Real not_before_tip(const ConicalForm<Real>& q, Real enter) {
  const bool is_before = (q.rate > 0) & (enter * q.rate < -q.radius);
  return __builtin_expect(is_before, 0) ? -q.radius / q.rate : enter;
}

/// Exit from the nappe, for points known to be in it and not leaving now.
template <class Real>
[[gnu::always_inline]] inline Real nappe_exit(const ConicalForm<Real>& q) {
  if (stays_in_nappe(q) || is_along_nappe(q)) return infinity<Real>();
  const Real root = square_root(larger(conical_discriminant(q), Real(0)));
  if (q.b < 0) return not_after_tip(q, larger((root - q.b) / q.a, Real(0)));
  const Real h = q.b + root, c = q.r2 - q.radius * q.radius;
  if (h > 0) return not_after_tip(q, larger(-c / h, Real(0)));
  if (!(c < 0)) return Real(0);
  return not_after_tip(q, q.a > 0 ? square_root(-c / q.a) : infinity<Real>());
}

/// Directional containment, for points that are not outside by more than the tolerance. A tangent
/// leaves, and so does a ray that comes no deeper than the tolerance. Otherwise rays nearly along
/// the face would leave and enter for ever, by steps too short to change the coordinates that
/// decide.
template <class Real>
[[gnu::always_inline]] inline bool heads_into_nappe(const ConicalForm<Real>& q, Real tol) {
  const Real inner = q.radius - tol;
  if (inner > 0 && q.r2 < inner * inner) return true;
  if (is_along_nappe(q)) return true;
  // At the tip all faces meet. Only directions within the cone head in.
  if (q.radius <= tol && q.r2 <= tol * tol) return stays_in_nappe(q);
  // `deepest` is `a` times the radius where the ray is deepest. There r2 is below radius^2 by
  // discriminant / a.
  const Real deepest = q.radius * q.a - q.rate * q.b;
  if (q.a > 0 && deepest > 0) {
    return q.b <= 0 && conical_discriminant(q) > tol * (2 * deepest - tol * q.a);
  }
  if (q.b < 0 && q.b < -tol * q.a) return true;
  return (q.b < 0 || (q.b == 0 && q.radius > 0)) && nappe_exit(q) > tol;
}
template <class Real>
[[gnu::always_inline]] inline bool within_tolerance_of_nappe(const ConicalForm<Real>& q, Real tol) {
  const Real outer = q.radius + tol;
  return outer >= 0 && q.r2 <= outer * outer;
}

template <class Real>
[[gnu::always_inline]] inline bool in_cone(const ConicalFace<Real>& f, const Vec3<Real>& p,
                                           const Direction<Real>& v, Real tol) {
  // Most points are far from the face. The direction matters only for those on the face.
  const Real x = f.cosine * p.x, y = f.cosine * p.y, radius = f.radius + f.slope * p.z;
  const Real r2 = x * x + y * y, outer = radius + tol, inner = radius - tol;
  if (!(outer >= 0 && r2 <= outer * outer)) return false;
  if (inner > 0 && r2 < inner * inner) return true;
  return heads_into_nappe(conical_form(f, p, v), tol);
}

/// Exit from the nappe, for points known to be in it.
template <class Real>
[[gnu::always_inline]] inline Real leave_cone(const ConicalFace<Real>& f, const Vec3<Real>& p,
                                              const Direction<Real>& v, Real tol) {
  const ConicalForm<Real> q = conical_form(f, p, v);
  if (within_tolerance_of_nappe(q, tol) ? !heads_into_nappe(q, tol) : !(q.b < 0)) return Real(0);
  return nappe_exit(q);
}

/// The span of the nappe. It is accurate for starts whose z is near the part of the nappe in
/// question.
template <class Real>
[[gnu::always_inline]] inline Span<Real> cone_span(const ConicalFace<Real>& f, const Vec3<Real>& p,
                                                   const Direction<Real>& v, Real tol) {
  const ConicalForm<Real> q = conical_form(f, p, v);
  const bool stays = stays_in_nappe(q);
  if (within_tolerance_of_nappe(q, tol)) {
    if (heads_into_nappe(q, tol)) {
      const Real leave = nappe_exit(q);
      return {-infinity<Real>(), leave, leave};
    }
    if (!stays) return no_span<Real>();
  }
  if (is_along_nappe(q)) return no_span<Real>();
  const Real discriminant = conical_discriminant(q), c = q.r2 - q.radius * q.radius;
  if (stays) {
    const Real root = square_root(larger(discriminant, Real(0)));
    const Real enter = q.b < 0 ? -c / (q.b - root) : -(q.b + root) / q.a;
    return {not_before_tip(q, larger(enter, Real(0))), infinity<Real>(), infinity<Real>()};
  }
  // The last condition distinguishes this nappe from the other one.
  if (!(q.b < 0) || !(discriminant > 0) || !(q.a >= 0) || !(q.radius * q.a > q.rate * q.b)) {
    return no_span<Real>();
  }
  const Real h = q.b - square_root(discriminant);
  const Real leave = not_after_tip(q, -h / q.a);
  return {not_before_tip(q, larger(-c / h, Real(0))), leave, leave};
}

/// Signed distance to the nappe, a lower bound on the distance on either side; rho = |(x, y)|.
template <class Real>
constexpr Real cone_distance(const ConicalFace<Real>& f, Real rho, Real z) {
  return f.cosine * rho - f.slope * z - f.radius;
}

/// A span that was measured from `shift` along the ray, as measured from the ray's start.
template <class Real>
[[gnu::always_inline]] constexpr Span<Real> shifted(const Span<Real>& span, Real shift) {
  return {span.enter < 0 ? span.enter : span.enter + shift, span.leave + shift, span.until + shift};
}

template <class Real>
struct Cone {
  Real hz;                         ///< half length, mm
  ConicalFace<Real> outer, inner;  ///< z from the centre
  int bored;                       ///< 0 if there is no inner face
  Wedge<Real> wedge;
};

template <class Real>
Side inside(const Cone<Real>& s, const Vec3<Real>& p, Real tol) {
  Side side = worse(Side::inside, absolute(p.z) - s.hz, tol);
  const Real rho = square_root(p.x * p.x + p.y * p.y);
  side = worse(side, cone_distance(s.outer, rho, p.z), tol);
  if (s.bored != 0) side = worse(side, -cone_distance(s.inner, rho, p.z), tol);
  if (s.wedge.kind != 0) side = worse(side, wedge_distance(s.wedge, p.x, p.y), tol);
  return side;
}

template <class Real>
bool contains(const Cone<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  if (beyond_face(absolute(p.z) - s.hz, p.z < 0 ? -v.z : v.z, tol)) return false;
  if (!in_cone(s.outer, p, v, tol)) return false;
  if (s.bored != 0 && in_cone(s.inner, p, v, tol)) return false;
  return in_wedge(s.wedge, p, v, tol);
}

template <class Real>
Real distance_to_entry(const Cone<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                       Real tol) {
  Span<Real> body = whole_ray<Real>();
  clip_slab(body, s.hz, p.z, v.z, v.inverse_z, tol);
  if (!is_ahead(body)) return infinity<Real>();
  // Spans of nappes are accurate for starts nearby, so they are taken from where the ray enters the
  // slab.
  const Real shift = larger(body.enter, Real(0));
  const Vec3<Real> q = advance(p, v, shift);
  const Span<Real> outer = shifted(cone_span(s.outer, q, v, tol), shift);
  body.enter = larger(outer.enter, body.enter);
  body.until = smaller(outer.until, body.until);
  if (!is_ahead(body)) return infinity<Real>();
  if (s.wedge.kind == 1) clip_to_wedge(s.wedge, p, v, tol, body);
  const Span<Real> bore =
      s.bored != 0 ? shifted(cone_span(s.inner, q, v, tol), shift) : no_span<Real>();
  return first_entry(body, bore, gap_span(s.wedge, p, v, tol));
}
template <class Real>
Real distance_to_in(const Cone<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  const Real t = distance_to_entry(s, p, v, tol);
  return t < 0 ? distance_from_within(s, p, tol) : t;
}

template <class Real>
Real distance_to_out(const Cone<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  Real leave = leave_cone(s.outer, p, v, tol);
  leave = leave_slab(s.hz, p.z, v.z, v.inverse_z, tol, leave);
  if (s.bored != 0) leave = leave_into_hole(cone_span(s.inner, p, v, tol), leave);
  return leave_wedge(s.wedge, p, v, tol, leave);
}

/// A ray that left into the bore or into a missing sector may come back.
inline bool is_left_for_good(const Cone<double>& s, const Vec3<double>& p, double tol) {
  if (s.bored == 0) return s.wedge.kind != 2;
  if (s.wedge.kind != 0) return false;
  const double rho = square_root(p.x * p.x + p.y * p.y);
  return (cone_distance(s.outer, rho, p.z) > -tol) & (cone_distance(s.inner, rho, p.z) > 8 * tol);
}

template <class Real>
Real safety_to_in(const Cone<Real>& s, const Vec3<Real>& p) {
  const Real rho = square_root(p.x * p.x + p.y * p.y);
  Real away = larger(absolute(p.z) - s.hz, Real(0));
  away = larger(cone_distance(s.outer, rho, p.z), away);
  if (s.bored != 0) away = larger(-cone_distance(s.inner, rho, p.z), away);
  if (s.wedge.kind != 0) away = larger(wedge_distance(s.wedge, p.x, p.y), away);
  return away;
}

template <class Real>
Real safety_to_out(const Cone<Real>& s, const Vec3<Real>& p) {
  const Real rho = square_root(p.x * p.x + p.y * p.y);
  Real depth = smaller(s.hz - absolute(p.z), -cone_distance(s.outer, rho, p.z));
  if (s.bored != 0) depth = smaller(cone_distance(s.inner, rho, p.z), depth);
  if (s.wedge.kind != 0) depth = smaller(-wedge_distance(s.wedge, p.x, p.y), depth);
  return larger(depth, Real(0));
}

}  // namespace navjit::kernels

// Beside navigation.
namespace navjit::kernels {

template <class Real>
constexpr Vec3<Real> conical_normal(const ConicalFace<Real>& f, const Radial<Real>& r) {
  return {f.cosine * r.x, f.cosine * r.y, -f.slope};
}
template <class Real>
void offer_nappe(NearestFace<Real>& best, const ConicalFace<Real>& f, bool hole,
                 const Vec3<Real>& p, const Radial<Real>& r) {
  const Real beyond = cone_distance(f, r.rho, p.z);
  const Vec3<Real> n = conical_normal(f, r);
  offer(best, hole ? -beyond : beyond, hole ? turned_over(n) : n);
}
template <class Real>
Vec3<Real> normal(const Cone<Real>& s, const Vec3<Real>& p, Real tol) {
  const Radial<Real> r = radial_at(p);
  NearestFace<Real> best = no_face(tol);
  offer_ends(best, -s.hz, s.hz, p.z);
  offer_nappe(best, s.outer, false, p, r);
  if (s.bored != 0) offer_nappe(best, s.inner, true, p, r);
  offer_wedge(best, s.wedge, p);
  return best.normal;
}

}  // namespace navjit::kernels
