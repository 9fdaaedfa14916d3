// A convex body given by the planes of its faces.
namespace navjit::kernels {

template <class Real>
struct Hull {
  const Plane<Real>* planes;
  int count;
};

/// The signed distance to the plane that the point is beyond most, or nearest to.
template <class Real>
Real hull_distance(const Hull<Real>& s, const Vec3<Real>& p) {
  Real beyond = -infinity<Real>();
  for (int i = 0; i < s.count; ++i) beyond = larger(plane_distance(s.planes[i], p), beyond);
  return beyond;
}

template <class Real>
Side inside(const Hull<Real>& s, const Vec3<Real>& p, Real tol) {
  return worse(Side::inside, hull_distance(s, p), tol);
}

template <class Real>
bool contains(const Hull<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  for (int i = 0; i < s.count; ++i) {
    if (beyond_plane(s.planes[i], p, v, tol)) return false;
  }
  return true;
}

template <class Real>
Real distance_to_in(const Hull<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  Span<Real> span = whole_ray<Real>();
  for (int i = 0; i < s.count; ++i) {
    clip_plane(span, s.planes[i], p, v, tol);
    if (!is_ahead(span)) return infinity<Real>();
  }
  return span.enter >= 0 ? span.enter : distance_from_within(s, p, tol);
}

template <class Real>
Real distance_to_out(const Hull<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  Real leave = infinity<Real>();
  for (int i = 0; i < s.count; ++i) leave = leave_plane(s.planes[i], p, v, tol, leave);
  return leave;
}

template <class Real>
Real safety_to_in(const Hull<Real>& s, const Vec3<Real>& p) {
  return larger(hull_distance(s, p), Real(0));
}
template <class Real>
Real safety_to_out(const Hull<Real>& s, const Vec3<Real>& p) {
  return larger(-hull_distance(s, p), Real(0));
}

}  // namespace navjit::kernels

// Beside navigation.
namespace navjit::kernels {

template <class Real>
Vec3<Real> normal(const Hull<Real>& s, const Vec3<Real>& p, Real tol) {
  NearestFace<Real> best = no_face(tol);
  for (int i = 0; i < s.count; ++i) offer_plane(best, s.planes[i], p);
  return best.normal;
}

}  // namespace navjit::kernels
