// A polycone: conical rings stacked along z, possibly cut to an azimuthal segment.
namespace navjit::kernels {

template <class Real>
struct Polycone {
  const Section<Real>* sections;  ///< in ascending z; those over the same z are disjoint rings
  int count;
  const Ledge<Real>* ledges;
  int ledge_count;
  Real z_low, z_high;  ///< the ends, mm
  Real rmax;           ///< largest radius, mm
  Wedge<Real> wedge;
};

template <class Real>
[[gnu::always_inline]] inline Span<Real> face_span(const Polycone<Real>&,
                                                   const ConicalFace<Real>& f, const Vec3<Real>& p,
                                                   const Direction<Real>& v, Real tol) {
  return cone_span(f, p, v, tol);
}
template <class Real>
[[gnu::always_inline]] inline bool in_face(const Polycone<Real>&, const ConicalFace<Real>& f,
                                           const Vec3<Real>& p, const Direction<Real>& v,
                                           Real tol) {
  return in_cone(f, p, v, tol);
}
template <class Real>
Real face_distance(const Polycone<Real>&, const ConicalFace<Real>& f, const Vec3<Real>& p,
                   Real rho) {
  return cone_distance(f, rho, p.z);
}

template <class Real>
Side inside(const Polycone<Real>& s, const Vec3<Real>& p, Real tol) {
  return sections_inside(s, p, tol);
}
template <class Real>
bool contains(const Polycone<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  return sections_contains(s, p, v, tol);
}
template <class Real>
Real distance_to_in(const Polycone<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                    Real tol) {
  return sections_distance_to_in(s, p, v, tol);
}
template <class Real>
Real distance_to_out(const Polycone<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                     Real tol) {
  return sections_distance_to_out(s, p, v, tol);
}
template <class Real>
Real safety_to_in(const Polycone<Real>& s, const Vec3<Real>& p) {
  return sections_safety_to_in(s, p);
}
template <class Real>
Real safety_to_out(const Polycone<Real>& s, const Vec3<Real>& p) {
  return sections_safety_to_out(s, p);
}

}  // namespace navjit::kernels

// Beside navigation.
namespace navjit::kernels {

template <class Real>
Vec3<Real> face_normal(const Polycone<Real>&, const ConicalFace<Real>& f, const Vec3<Real>& p,
                       Real) {
  return conical_normal(f, radial_at(p));
}
template <class Real>
Vec3<Real> normal(const Polycone<Real>& s, const Vec3<Real>& p, Real tol) {
  return sections_normal(s, p, tol);
}

}  // namespace navjit::kernels
