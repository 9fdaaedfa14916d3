// A box centred on the origin.
namespace navjit::kernels {

template <class Real>
struct Box {
  Real hx, hy, hz;  ///< half lengths, mm
};

template <class Real>
Side inside(const Box<Real>& s, const Vec3<Real>& p, Real tol) {
  Side side = Side::inside;
  side = worse(side, absolute(p.x) - s.hx, tol);
  side = worse(side, absolute(p.y) - s.hy, tol);
  return worse(side, absolute(p.z) - s.hz, tol);
}

// Most volumes are boxes, and most directions run along none of their faces. For these directions
// the functions have a short way, in which all three axes are turned so that the ray ascends. For
// the other directions there are functions out of line, so that they take no registers from the
// short way. Both ways give the same bits.

/// The coordinate along an axis that is turned so that the ray ascends. `v` is never negative zero.
template <class Real>
constexpr Real ascending(Real p, Real v) {
  return v < 0 ? -p : p;
}
template <>
constexpr double ascending<double>(double p, double v) {
  constexpr unsigned long long sign = 1ULL << 63;
  return __builtin_bit_cast(double, __builtin_bit_cast(unsigned long long, p) ^
                                        (__builtin_bit_cast(unsigned long long, v) & sign));
}

// The functions out of line take single numbers. Compilers would keep structs in memory for them,
// all along the short way.

template <class Real>
[[gnu::noinline, gnu::cold]] bool contains_along_faces(Real hx, Real hy, Real hz, Real x, Real y,
                                                       Real z, Real u, Real v, Real w, Real tol) {
  return !(beyond_face(absolute(x) - hx, x < 0 ? -u : u, tol) |
           beyond_face(absolute(y) - hy, y < 0 ? -v : v, tol) |
           beyond_face(absolute(z) - hz, z < 0 ? -w : w, tol));
}
template <class Real>
bool contains(const Box<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  if (__builtin_expect(is_oblique(v) & (s.hx > tol) & (s.hy > tol) & (s.hz > tol), 1)) {
    const Real x = ascending(p.x, v.x), y = ascending(p.y, v.y), z = ascending(p.z, v.z);
    const Real ahead = smaller(s.hx - x, smaller(s.hy - y, s.hz - z));
    const Real before = larger(-s.hx - x, larger(-s.hy - y, -s.hz - z));
    return (ahead > tol) & (before <= tol);
  }
  return contains_along_faces(s.hx, s.hy, s.hz, p.x, p.y, p.z, v.x, v.y, v.z, tol);
}

template <class Real>
[[gnu::noinline, gnu::cold]] Real distance_from_within_box(Real hx, Real hy, Real hz, Real x,
                                                           Real y, Real z, Real tol) {
  return distance_from_within(Box<Real>{hx, hy, hz}, Vec3<Real>{x, y, z}, tol);
}
template <class Real>
[[gnu::noinline, gnu::cold]] Real distance_along_faces(Real hx, Real hy, Real hz, Real x, Real y,
                                                       Real z, Real u, Real v, Real w, Real tol) {
  const Direction<Real> d = make_direction(u, v, w);
  Span<Real> span = whole_ray<Real>();
  clip_slab(span, hx, x, d.x, d.inverse_x, tol);
  clip_slab(span, hy, y, d.y, d.inverse_y, tol);
  clip_slab(span, hz, z, d.z, d.inverse_z, tol);
  if (!is_ahead(span)) return infinity<Real>();
  if (span.enter >= 0) return span.enter;
  return distance_from_within_box(hx, hy, hz, x, y, z, tol);
}
template <class Real>
Real distance_to_entry(const Box<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                       Real tol) {
  const Real x = ascending(p.x, v.x), y = ascending(p.y, v.y), z = ascending(p.z, v.z);
  const Real rate_x = absolute(v.inverse_x), rate_y = absolute(v.inverse_y),
             rate_z = absolute(v.inverse_z);
  const Real until = smaller((s.hx - tol - x) * rate_x,
                             smaller((s.hy - tol - y) * rate_y, (s.hz - tol - z) * rate_z));
  const Real before_x = -s.hx - x, before_y = -s.hy - y, before_z = -s.hz - z;
  Real enter = Real(-1);
  enter = before_x > tol ? before_x * rate_x : enter;
  enter = before_y > tol ? larger(before_y * rate_y, enter) : enter;
  enter = before_z > tol ? larger(before_z * rate_z, enter) : enter;
  return ((enter < until) & (until > 0)) ? enter : infinity<Real>();
}
template <class Real>
Real distance_to_in(const Box<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  if (__builtin_expect(!is_oblique(v), 0)) {
    return distance_along_faces(s.hx, s.hy, s.hz, p.x, p.y, p.z, v.x, v.y, v.z, tol);
  }
  const Real t = distance_to_entry(s, p, v, tol);
  if (__builtin_expect(t < 0, 0)) {
    return distance_from_within_box(s.hx, s.hy, s.hz, p.x, p.y, p.z, tol);
  }
  return t;
}

template <class Real>
[[gnu::noinline, gnu::cold]] Real exit_along_faces(Real hx, Real hy, Real hz, Real x, Real y,
                                                   Real z, Real u, Real v, Real w, Real tol) {
  const Direction<Real> d = make_direction(u, v, w);
  Real leave = infinity<Real>();
  leave = leave_slab(hx, x, d.x, d.inverse_x, tol, leave);
  leave = smaller(leave_slab(hy, y, d.y, d.inverse_y, tol, leave), leave);
  return smaller(leave_slab(hz, z, d.z, d.inverse_z, tol, leave), leave);
}
template <class Real>
Real distance_to_exit(const Box<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  const Real x = s.hx - ascending(p.x, v.x), y = s.hy - ascending(p.y, v.y),
             z = s.hz - ascending(p.z, v.z);
  const Real leave = smaller(x * absolute(v.inverse_x),
                             smaller(y * absolute(v.inverse_y), z * absolute(v.inverse_z)));
  return smaller(x, smaller(y, z)) <= tol ? Real(0) : leave;
}
template <class Real>
Real distance_to_out(const Box<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  if (__builtin_expect(!is_oblique(v), 0)) {
    return exit_along_faces(s.hx, s.hy, s.hz, p.x, p.y, p.z, v.x, v.y, v.z, tol);
  }
  return distance_to_exit(s, p, v, tol);
}

inline bool is_left_for_good(const Box<double>&, const Vec3<double>&, double) { return true; }

template <class Real>
Real safety_to_in(const Box<Real>& s, const Vec3<Real>& p) {
  Real away = larger(absolute(p.x) - s.hx, Real(0));
  away = larger(absolute(p.y) - s.hy, away);
  return larger(absolute(p.z) - s.hz, away);
}

template <class Real>
Real safety_to_out(const Box<Real>& s, const Vec3<Real>& p) {
  Real depth = s.hx - absolute(p.x);
  depth = smaller(s.hy - absolute(p.y), depth);
  depth = smaller(s.hz - absolute(p.z), depth);
  return larger(depth, Real(0));
}

}  // namespace navjit::kernels

// Beside navigation.
namespace navjit::kernels {

template <class Real>
Vec3<Real> normal(const Box<Real>& s, const Vec3<Real>& p, Real tol) {
  NearestFace<Real> best = no_face(tol);
  offer(best, absolute(p.x) - s.hx, Vec3<Real>{with_sign(Real(1), p.x), 0, 0});
  offer(best, absolute(p.y) - s.hy, Vec3<Real>{0, with_sign(Real(1), p.y), 0});
  offer(best, absolute(p.z) - s.hz, Vec3<Real>{0, 0, with_sign(Real(1), p.z)});
  return best.normal;
}

}  // namespace navjit::kernels
