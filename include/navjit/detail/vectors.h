// Vectors and directions. Freestanding: generated navigators begin with this text, too.
#ifndef NAVJIT_DETAIL_VECTORS_H
#define NAVJIT_DETAIL_VECTORS_H
namespace navjit::kernels {

template <class Real>
struct Vec3 {
  Real x, y, z;
};

/// A direction with its reciprocals. Components are never negative zero; the reciprocal of a zero
/// component is +infinity, which the slab tests rely on.
template <class Real>
struct Direction {
  Real x, y, z;
  Real inverse_x, inverse_y, inverse_z;
};

template <class Real>
constexpr Direction<Real> make_direction(Real x, Real y, Real z) {
  // Adding +0 turns -0 into +0, so that reciprocals of zero are +infinity.
  const Real cx = x + Real(0), cy = y + Real(0), cz = z + Real(0);
  return {cx, cy, cz, Real(1) / cx, Real(1) / cy, Real(1) / cz};
}

}  // namespace navjit::kernels
#endif
