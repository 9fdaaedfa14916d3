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

template <class Real>
bool contains(const Box<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  return !(beyond_face(absolute(p.x) - s.hx, p.x < 0 ? -v.x : v.x, tol) ||
           beyond_face(absolute(p.y) - s.hy, p.y < 0 ? -v.y : v.y, tol) ||
           beyond_face(absolute(p.z) - s.hz, p.z < 0 ? -v.z : v.z, tol));
}

template <class Real>
Real distance_to_in(const Box<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  Span<Real> span = whole_ray<Real>();
  clip_slab(span, s.hx, p.x, v.x, v.inverse_x, tol);
  clip_slab(span, s.hy, p.y, v.y, v.inverse_y, tol);
  clip_slab(span, s.hz, p.z, v.z, v.inverse_z, tol);
  if (!is_ahead(span)) return infinity<Real>();
  return span.enter >= 0 ? span.enter : distance_from_within(s, p, tol);
}

template <class Real>
Real distance_to_out(const Box<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  Real leave = infinity<Real>();
  leave = leave_slab(s.hx, p.x, v.x, v.inverse_x, tol, leave);
  leave = smaller(leave_slab(s.hy, p.y, v.y, v.inverse_y, tol, leave), leave);
  return smaller(leave_slab(s.hz, p.z, v.z, v.inverse_z, tol, leave), leave);
}

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
