// A solid that is stretched along the axes, by a factor for each axis.
namespace navjit::kernels {

/// local = inverse * p, component by component.
template <class Real, class Solid>
struct Scaled {
  Solid solid;
  Real inverse_x, inverse_y, inverse_z;  ///< negative where the axis is reversed
  Real most;                             ///< the largest of their magnitudes
};

template <class Real, class S>
Vec3<Real> to_local(const Scaled<Real, S>& s, const Vec3<Real>& p) {
  return {s.inverse_x * p.x, s.inverse_y * p.y, s.inverse_z * p.z};
}
/// The local direction, and the factor by which paths are longer in the local frame.
template <class Real>
struct ScaledDirection {
  Direction<Real> v;
  Real stretch;
};
template <class Real, class S>
ScaledDirection<Real> to_local(const Scaled<Real, S>& s, const Direction<Real>& v) {
  const Real x = s.inverse_x * v.x, y = s.inverse_y * v.y, z = s.inverse_z * v.z;
  const Real stretch = square_root(x * x + y * y + z * z);
  return {make_direction<Real>(x / stretch, y / stretch, z / stretch), stretch};
}

// No distance across a face is stretched by more than `most`.

template <class Real, class S>
Side inside(const Scaled<Real, S>& s, const Vec3<Real>& p, Real tol) {
  return inside(s.solid, to_local(s, p), tol * s.most);
}
template <class Real, class S>
bool contains(const Scaled<Real, S>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  return contains(s.solid, to_local(s, p), to_local(s, v).v, tol * s.most);
}
template <class Real, class S>
Real distance_to_in(const Scaled<Real, S>& s, const Vec3<Real>& p, const Direction<Real>& v,
                    Real tol) {
  const ScaledDirection<Real> local = to_local(s, v);
  return distance_to_in(s.solid, to_local(s, p), local.v, tol * s.most) / local.stretch;
}
template <class Real, class S>
Real distance_to_out(const Scaled<Real, S>& s, const Vec3<Real>& p, const Direction<Real>& v,
                     Real tol) {
  const ScaledDirection<Real> local = to_local(s, v);
  return distance_to_out(s.solid, to_local(s, p), local.v, tol * s.most) / local.stretch;
}
template <class Real, class S>
Real safety_to_in(const Scaled<Real, S>& s, const Vec3<Real>& p) {
  return safety_to_in(s.solid, to_local(s, p)) / s.most;
}
template <class Real, class S>
Real safety_to_out(const Scaled<Real, S>& s, const Vec3<Real>& p) {
  return safety_to_out(s.solid, to_local(s, p)) / s.most;
}

}  // namespace navjit::kernels

// Beside navigation.
namespace navjit::kernels {

/// The nearest face is that of the solid before it was stretched.
template <class Real, class S>
Vec3<Real> normal(const Scaled<Real, S>& s, const Vec3<Real>& p, Real tol) {
  const Vec3<Real> n = normal(s.solid, to_local(s, p), tol * s.most);
  return unit_vector(Vec3<Real>{s.inverse_x * n.x, s.inverse_y * n.y, s.inverse_z * n.z});
}

}  // namespace navjit::kernels
