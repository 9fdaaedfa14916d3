// The azimuthal segment that tubes, cones, spheres and their like may be cut to: the sector between
// two half-planes through the z axis. Up to half a turn it is convex; beyond, its complement is.
namespace navjit::kernels {

template <class Real>
struct Wedge {
  int kind;               ///< 0 full turn; 1 at most half a turn; 2 more than half a turn
  Real start_x, start_y;  ///< unit vector along the start edge
  Real end_x, end_y;      ///< unit vector along the end edge
};

/// The convex one of the sector and its complement: where both signed distances are negative.
/// `first` and `second` are the outward normals times (x, y).
template <class Real>
struct WedgeForm {
  Real first, second;
};
template <class Real>
[[gnu::always_inline]] inline WedgeForm<Real> wedge_form(const Wedge<Real>& w, Real x, Real y) {
  const Real first = w.start_y * x - w.start_x * y;
  const Real second = w.end_x * y - w.end_y * x;
  return w.kind == 1 ? WedgeForm<Real>{first, second} : WedgeForm<Real>{-first, -second};
}

/// Clips a span to the convex wedge (kind 1), or, from the whole ray, gives the span of the missing
/// sector (kind 2).
template <class Real>
[[gnu::always_inline]] inline void clip_to_wedge(const Wedge<Real>& w, const Vec3<Real>& p,
                                                 const Direction<Real>& v, Real tol,
                                                 Span<Real>& span) {
  const WedgeForm<Real> at = wedge_form(w, p.x, p.y), along = wedge_form(w, v.x, v.y);
  clip_face(span, at.first, along.first, tol);
  clip_face(span, at.second, along.second, tol);
}
/// The span of the missing sector; none unless the wedge is of kind 2.
template <class Real>
[[gnu::always_inline]] inline Span<Real> gap_span(const Wedge<Real>& w, const Vec3<Real>& p,
                                                  const Direction<Real>& v, Real tol) {
  if (w.kind != 2) return no_span<Real>();
  Span<Real> gap = whole_ray<Real>();
  clip_to_wedge(w, p, v, tol, gap);
  return gap;
}

/// The smaller of `leave` and the path to the exit from the sector, for points known to be in it.
template <class Real>
[[gnu::always_inline]] inline Real leave_wedge(const Wedge<Real>& w, const Vec3<Real>& p,
                                               const Direction<Real>& v, Real tol, Real leave) {
  if (w.kind == 0) return leave;
  if (w.kind == 2) return leave_into_hole(gap_span(w, p, v, tol), leave);
  const WedgeForm<Real> at = wedge_form(w, p.x, p.y), along = wedge_form(w, v.x, v.y);
  leave = leave_face(at.first, along.first, tol, leave);
  return smaller(leave_face(at.second, along.second, tol, leave), leave);
}

/// Directional containment in the convex form, which is the sector for kind 1 and the missing
/// sector for kind 2.
template <class Real>
[[gnu::always_inline]] inline bool in_convex_wedge(const Wedge<Real>& w, const Vec3<Real>& p,
                                                   const Direction<Real>& v, Real tol) {
  const WedgeForm<Real> at = wedge_form(w, p.x, p.y), along = wedge_form(w, v.x, v.y);
  return !beyond_face(at.first, along.first, tol) && !beyond_face(at.second, along.second, tol);
}

/// Directional containment in the sector itself.
template <class Real>
[[gnu::always_inline]] inline bool in_wedge(const Wedge<Real>& w, const Vec3<Real>& p,
                                            const Direction<Real>& v, Real tol) {
  return w.kind == 0 || in_convex_wedge(w, p, v, tol) == (w.kind == 1);
}

/// Signed distance to the sector's faces: > 0 outside (a lower bound of the distance), < 0 inside
/// (minus a lower bound of the depth).
template <class Real>
Real wedge_distance(const Wedge<Real>& w, Real x, Real y) {
  const WedgeForm<Real> at = wedge_form(w, x, y);
  const Real convex = larger(at.first, at.second);
  return w.kind == 1 ? convex : -convex;
}

}  // namespace navjit::kernels

// Beside navigation.
namespace navjit::kernels {

/// The side of the wedge that is nearest to the point, as a face. The outward normals are the same
/// whether the wedge is less than half a turn or more.
template <class Real>
NearestFace<Real> wedge_face(const Wedge<Real>& w, const Vec3<Real>& p, Real tol) {
  if (w.kind == 0) return no_face(tol);
  const WedgeForm<Real> at = wedge_form(w, p.x, p.y);
  const Vec3<Real> start{w.start_y, -w.start_x, 0}, end{-w.end_y, w.end_x, 0};
  return {wedge_distance(w, p.x, p.y), at.second > at.first + tol ? end : start, tol};
}
template <class Real>
void offer_wedge(NearestFace<Real>& best, const Wedge<Real>& w, const Vec3<Real>& p) {
  const NearestFace<Real> side = wedge_face(w, p, best.tol);
  if (w.kind != 0) offer(best, side.beyond, side.normal);
}

}  // namespace navjit::kernels
