// A convex body given by the planes of its faces.
namespace navjit::kernels {

/// Eight planes. Where fewer are left, some occur more than once.
template <class Real>
struct PlaneGroup {
  EightOf<Real> a, b, c, d;
};

template <class Real>
struct Hull {
  const Plane<Real>* planes;
  int count;
  const PlaneGroup<Real>* groups;  ///< the same planes, in groups of eight
  int group_count;
};

template <>
inline constexpr bool uses_vectors<Hull<double>> = true;

inline FaceLanes<EightLanes> faces_of(const PlaneGroup<double>& g, const Vec3<double>& p,
                                      const Direction<double>& v) {
  const EightLanes a = lanes_from(g.a), b = lanes_from(g.b), c = lanes_from(g.c);
  return {a * p.x + b * p.y + c * p.z + lanes_from(g.d), a * v.x + b * v.y + c * v.z};
}

/// The signed distance to the plane that the point is furthest beyond, or nearest to from within.
template <class Real>
Real hull_distance(const Hull<Real>& s, const Vec3<Real>& p) {
  Real beyond = -infinity<Real>();
  for (int i = 0; i < s.count; ++i) beyond = larger(plane_distance(s.planes[i], p), beyond);
  return beyond;
}

inline double hull_distance(const Hull<double>& s, const Vec3<double>& p) {
  EightLanes beyond = eight_of(-infinity<double>());
  for (int i = 0; i < s.group_count; ++i) {
    const PlaneGroup<double>& g = s.groups[i];
    const EightLanes of_plane =
        lanes_from(g.a) * p.x + lanes_from(g.b) * p.y + lanes_from(g.c) * p.z + lanes_from(g.d);
    beyond = of_plane > beyond ? of_plane : beyond;
  }
  return largest_lane(beyond);
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

// The same functions for double, eight planes at once.
inline bool contains(const Hull<double>& s, const Vec3<double>& p, const Direction<double>& v,
                     double tol) {
  for (int i = 0; i < s.group_count; ++i) {
    if (beyond_any(faces_of(s.groups[i], p, v), tol)) return false;
  }
  return true;
}
inline double distance_to_in(const Hull<double>& s, const Vec3<double>& p,
                             const Direction<double>& v, double tol) {
  FaceSpans<EightLanes> faces;
  for (int i = 0; i < s.group_count; ++i) faces.clip(faces_of(s.groups[i], p, v), tol);
  const Span<double> span = faces.span();
  if (!is_ahead(span)) return infinity<double>();
  return span.enter >= 0 ? span.enter : distance_from_within(s, p, tol);
}
inline double distance_to_out(const Hull<double>& s, const Vec3<double>& p,
                              const Direction<double>& v, double tol) {
  FaceExits<EightLanes> faces;
  for (int i = 0; i < s.group_count; ++i) faces.leave(faces_of(s.groups[i], p, v), tol);
  return faces.path();
}

inline bool is_left_for_good(const Hull<double>&, const Vec3<double>&, double) { return true; }

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
