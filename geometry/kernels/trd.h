// A trapezoid symmetric about the z axis: half lengths in x and y that change linearly with z.
namespace navjit::kernels {

/// Two faces that mirror each other. Their signed distance is across * |u| + along * z - offset,
/// where u is x or y, and (across, along) is a unit vector.
template <class Real>
struct FacePair {
  Real across, along, offset;
};

template <class Real>
struct Trd {
  Real hz;              ///< half length, mm
  FacePair<Real> x, y;  ///< the sloping sides
};

template <class Real>
constexpr Real pair_distance(const FacePair<Real>& f, Real u, Real z) {
  return f.across * absolute(u) + f.along * z - f.offset;
}
template <class Real>
constexpr bool beyond_pair(const FacePair<Real>& f, Real u, Real z, Real vu, Real vz, Real tol) {
  const Real common = f.along * z - f.offset, rate = f.along * vz;
  const Real su = f.across * u, nu = f.across * vu;
  return beyond_face(su + common, nu + rate, tol) || beyond_face(common - su, rate - nu, tol);
}
template <class Real>
constexpr void clip_pair(Span<Real>& span, const FacePair<Real>& f, Real u, Real z, Real vu,
                         Real vz, Real tol) {
  const Real common = f.along * z - f.offset, rate = f.along * vz;
  const Real su = f.across * u, nu = f.across * vu;
  clip_face(span, su + common, nu + rate, tol);
  clip_face(span, common - su, rate - nu, tol);
}
template <class Real>
constexpr Real leave_pair(const FacePair<Real>& f, Real u, Real z, Real vu, Real vz, Real tol,
                          Real leave) {
  const Real common = f.along * z - f.offset, rate = f.along * vz;
  const Real su = f.across * u, nu = f.across * vu;
  leave = leave_face(su + common, nu + rate, tol, leave);
  return smaller(leave_face(common - su, rate - nu, tol, leave), leave);
}

template <>
inline constexpr bool uses_vectors<Trd<double>> = true;

/// The four sides at once.
inline FaceLanes<Doubles> sides_of(const Trd<double>& s, const Vec3<double>& p,
                                   const Direction<double>& v) {
  const double x = s.x.along * p.z - s.x.offset, y = s.y.along * p.z - s.y.offset;
  const double rate_x = s.x.along * v.z, rate_y = s.y.along * v.z;
  const Doubles across = {s.x.across, s.x.across, s.y.across, s.y.across};
  return {across * Doubles{p.x, -p.x, p.y, -p.y} + Doubles{x, x, y, y},
          across * Doubles{v.x, -v.x, v.y, -v.y} + Doubles{rate_x, rate_x, rate_y, rate_y}};
}

template <class Real>
Side inside(const Trd<Real>& s, const Vec3<Real>& p, Real tol) {
  Side side = worse(Side::inside, absolute(p.z) - s.hz, tol);
  side = worse(side, pair_distance(s.x, p.x, p.z), tol);
  return worse(side, pair_distance(s.y, p.y, p.z), tol);
}

template <class Real>
bool contains(const Trd<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  return !(beyond_face(absolute(p.z) - s.hz, p.z < 0 ? -v.z : v.z, tol) ||
           beyond_pair(s.x, p.x, p.z, v.x, v.z, tol) || beyond_pair(s.y, p.y, p.z, v.y, v.z, tol));
}

template <class Real>
Real distance_to_entry(const Trd<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                       Real tol) {
  Span<Real> span = whole_ray<Real>();
  clip_slab(span, s.hz, p.z, v.z, v.inverse_z, tol);
  if (!is_ahead(span)) return infinity<Real>();
  clip_pair(span, s.x, p.x, p.z, v.x, v.z, tol);
  clip_pair(span, s.y, p.y, p.z, v.y, v.z, tol);
  if (!is_ahead(span)) return infinity<Real>();
  return span.enter >= 0 ? span.enter : Real(-1);
}
template <class Real>
Real distance_to_in(const Trd<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  const Real t = distance_to_entry(s, p, v, tol);
  return t < 0 ? distance_from_within(s, p, tol) : t;
}

template <class Real>
Real distance_to_out(const Trd<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  Real leave = leave_slab(s.hz, p.z, v.z, v.inverse_z, tol, infinity<Real>());
  leave = smaller(leave_pair(s.x, p.x, p.z, v.x, v.z, tol, leave), leave);
  return smaller(leave_pair(s.y, p.y, p.z, v.y, v.z, tol, leave), leave);
}

// The same functions for double, all sides at once.
inline bool contains(const Trd<double>& s, const Vec3<double>& p, const Direction<double>& v,
                     double tol) {
  return !(beyond_face(absolute(p.z) - s.hz, p.z < 0 ? -v.z : v.z, tol) |
           beyond_any(sides_of(s, p, v), tol));
}
inline double distance_to_entry(const Trd<double>& s, const Vec3<double>& p,
                                const Direction<double>& v, double tol) {
  FaceSpans<Doubles> sides;
  sides.clip(sides_of(s, p, v), tol);
  Span<double> span = sides.span();
  clip_slab(span, s.hz, p.z, v.z, v.inverse_z, tol);
  if (!is_ahead(span)) return infinity<double>();
  return span.enter >= 0 ? span.enter : -1.0;
}
inline double distance_to_out(const Trd<double>& s, const Vec3<double>& p,
                              const Direction<double>& v, double tol) {
  FaceExits<Doubles> sides;
  sides.leave(sides_of(s, p, v), tol);
  return leave_slab(s.hz, p.z, v.z, v.inverse_z, tol, sides.path());
}

inline bool is_left_for_good(const Trd<double>&, const Vec3<double>&, double) { return true; }

template <class Real>
Real safety_to_in(const Trd<Real>& s, const Vec3<Real>& p) {
  Real away = larger(absolute(p.z) - s.hz, Real(0));
  away = larger(pair_distance(s.x, p.x, p.z), away);
  return larger(pair_distance(s.y, p.y, p.z), away);
}

template <class Real>
Real safety_to_out(const Trd<Real>& s, const Vec3<Real>& p) {
  Real depth = s.hz - absolute(p.z);
  depth = smaller(-pair_distance(s.x, p.x, p.z), depth);
  depth = smaller(-pair_distance(s.y, p.y, p.z), depth);
  return larger(depth, Real(0));
}

}  // namespace navjit::kernels

// Beside navigation.
namespace navjit::kernels {

template <class Real>
Vec3<Real> normal(const Trd<Real>& s, const Vec3<Real>& p, Real tol) {
  NearestFace<Real> best = no_face(tol);
  offer(best, absolute(p.z) - s.hz, Vec3<Real>{0, 0, with_sign(Real(1), p.z)});
  offer(best, pair_distance(s.x, p.x, p.z), Vec3<Real>{with_sign(s.x.across, p.x), 0, s.x.along});
  offer(best, pair_distance(s.y, p.y, p.z), Vec3<Real>{0, with_sign(s.y.across, p.y), s.y.along});
  return best.normal;
}

}  // namespace navjit::kernels
