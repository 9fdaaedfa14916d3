// A general trapezoid: two faces across z and four planes in any direction.
namespace navjit::kernels {

/// Signed distance = a x + b y + c z + d, with (a, b, c) the outward unit normal.
template <class Real>
struct Plane {
  Real a, b, c, d;
};

template <class Real>
struct Trap {
  Real hz;                                       ///< half length, mm
  Plane<Real> y_minus, y_plus, x_minus, x_plus;  ///< the sides
};

template <class Real>
constexpr Real plane_distance(const Plane<Real>& f, const Vec3<Real>& p) {
  return f.a * p.x + f.b * p.y + f.c * p.z + f.d;
}
template <class Real>
constexpr Real plane_rate(const Plane<Real>& f, const Direction<Real>& v) {
  return f.a * v.x + f.b * v.y + f.c * v.z;
}
template <class Real>
constexpr bool beyond_plane(const Plane<Real>& f, const Vec3<Real>& p, const Direction<Real>& v,
                            Real tol) {
  return beyond_face(plane_distance(f, p), plane_rate(f, v), tol);
}
template <class Real>
constexpr void clip_plane(Span<Real>& span, const Plane<Real>& f, const Vec3<Real>& p,
                          const Direction<Real>& v, Real tol) {
  clip_face(span, plane_distance(f, p), plane_rate(f, v), tol);
}
template <class Real>
constexpr Real leave_plane(const Plane<Real>& f, const Vec3<Real>& p, const Direction<Real>& v,
                           Real tol, Real leave) {
  return smaller(leave_face(plane_distance(f, p), plane_rate(f, v), tol, leave), leave);
}

template <>
inline constexpr bool uses_vectors<Trap<double>> = true;

/// The four sides at once.
inline FaceLanes<Doubles> sides_of(const Trap<double>& s, const Vec3<double>& p,
                                   const Direction<double>& v) {
  const auto load = [](const Plane<double>& f) {
    Doubles lanes;
    __builtin_memcpy(&lanes, &f, sizeof lanes);
    return lanes;
  };
  const Doubles f = load(s.y_minus), g = load(s.y_plus), h = load(s.x_minus), k = load(s.x_plus);
  // The planes are transposed into vectors of coefficients.
  const Doubles ac_y = __builtin_shufflevector(f, g, 0, 4, 2, 6);
  const Doubles bd_y = __builtin_shufflevector(f, g, 1, 5, 3, 7);
  const Doubles ac_x = __builtin_shufflevector(h, k, 0, 4, 2, 6);
  const Doubles bd_x = __builtin_shufflevector(h, k, 1, 5, 3, 7);
  const Doubles a = __builtin_shufflevector(ac_y, ac_x, 0, 1, 4, 5);
  const Doubles b = __builtin_shufflevector(bd_y, bd_x, 0, 1, 4, 5);
  const Doubles c = __builtin_shufflevector(ac_y, ac_x, 2, 3, 6, 7);
  const Doubles d = __builtin_shufflevector(bd_y, bd_x, 2, 3, 6, 7);
  return {a * p.x + b * p.y + c * p.z + d, a * v.x + b * v.y + c * v.z};
}

template <class Real>
Side inside(const Trap<Real>& s, const Vec3<Real>& p, Real tol) {
  Side side = worse(Side::inside, absolute(p.z) - s.hz, tol);
  side = worse(side, plane_distance(s.y_minus, p), tol);
  side = worse(side, plane_distance(s.y_plus, p), tol);
  side = worse(side, plane_distance(s.x_minus, p), tol);
  return worse(side, plane_distance(s.x_plus, p), tol);
}

template <class Real>
bool contains(const Trap<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  return !(beyond_face(absolute(p.z) - s.hz, p.z < 0 ? -v.z : v.z, tol) ||
           beyond_plane(s.y_minus, p, v, tol) || beyond_plane(s.y_plus, p, v, tol) ||
           beyond_plane(s.x_minus, p, v, tol) || beyond_plane(s.x_plus, p, v, tol));
}

template <class Real>
Real distance_to_in(const Trap<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  Span<Real> span = whole_ray<Real>();
  clip_slab(span, s.hz, p.z, v.z, v.inverse_z, tol);
  if (!is_ahead(span)) return infinity<Real>();
  clip_plane(span, s.y_minus, p, v, tol);
  clip_plane(span, s.y_plus, p, v, tol);
  clip_plane(span, s.x_minus, p, v, tol);
  clip_plane(span, s.x_plus, p, v, tol);
  if (!is_ahead(span)) return infinity<Real>();
  return span.enter >= 0 ? span.enter : distance_from_within(s, p, tol);
}

template <class Real>
Real distance_to_out(const Trap<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  Real leave = leave_slab(s.hz, p.z, v.z, v.inverse_z, tol, infinity<Real>());
  leave = leave_plane(s.y_minus, p, v, tol, leave);
  leave = leave_plane(s.y_plus, p, v, tol, leave);
  leave = leave_plane(s.x_minus, p, v, tol, leave);
  return leave_plane(s.x_plus, p, v, tol, leave);
}

// The same functions for double, all sides at once.
inline bool contains(const Trap<double>& s, const Vec3<double>& p, const Direction<double>& v,
                     double tol) {
  return !(beyond_face(absolute(p.z) - s.hz, p.z < 0 ? -v.z : v.z, tol) |
           beyond_any(sides_of(s, p, v), tol));
}
inline double distance_to_in(const Trap<double>& s, const Vec3<double>& p,
                             const Direction<double>& v, double tol) {
  FaceSpans<Doubles> sides;
  sides.clip(sides_of(s, p, v), tol);
  Span<double> span = sides.span();
  clip_slab(span, s.hz, p.z, v.z, v.inverse_z, tol);
  if (!is_ahead(span)) return infinity<double>();
  return span.enter >= 0 ? span.enter : distance_from_within(s, p, tol);
}
inline double distance_to_out(const Trap<double>& s, const Vec3<double>& p,
                              const Direction<double>& v, double tol) {
  FaceExits<Doubles> sides;
  sides.leave(sides_of(s, p, v), tol);
  return leave_slab(s.hz, p.z, v.z, v.inverse_z, tol, sides.path());
}

inline bool is_left_for_good(const Trap<double>&, const Vec3<double>&, double) { return true; }

template <class Real>
Real safety_to_in(const Trap<Real>& s, const Vec3<Real>& p) {
  Real away = larger(absolute(p.z) - s.hz, Real(0));
  away = larger(plane_distance(s.y_minus, p), away);
  away = larger(plane_distance(s.y_plus, p), away);
  away = larger(plane_distance(s.x_minus, p), away);
  return larger(plane_distance(s.x_plus, p), away);
}

template <class Real>
Real safety_to_out(const Trap<Real>& s, const Vec3<Real>& p) {
  Real depth = s.hz - absolute(p.z);
  depth = smaller(-plane_distance(s.y_minus, p), depth);
  depth = smaller(-plane_distance(s.y_plus, p), depth);
  depth = smaller(-plane_distance(s.x_minus, p), depth);
  depth = smaller(-plane_distance(s.x_plus, p), depth);
  return larger(depth, Real(0));
}

}  // namespace navjit::kernels

// Beside navigation.
namespace navjit::kernels {

template <class Real>
constexpr void offer_plane(NearestFace<Real>& best, const Plane<Real>& f, const Vec3<Real>& p) {
  offer(best, plane_distance(f, p), Vec3<Real>{f.a, f.b, f.c});
}
template <class Real>
Vec3<Real> normal(const Trap<Real>& s, const Vec3<Real>& p, Real tol) {
  NearestFace<Real> best = no_face(tol);
  offer(best, absolute(p.z) - s.hz, Vec3<Real>{0, 0, with_sign(Real(1), p.z)});
  offer_plane(best, s.y_minus, p);
  offer_plane(best, s.y_plus, p);
  offer_plane(best, s.x_minus, p);
  offer_plane(best, s.x_plus, p);
  return best.normal;
}

}  // namespace navjit::kernels
