// What every kernel needs besides vectors (navjit/detail/vectors.h): the conventions, and a few
// functions of numbers and directions. This text is freestanding, as it is also near the head of
// every generated navigator.
//
// Conventions shared by all kernels (docs/tolerance.md gives the reasons):
//   inside(s, p, tol)            where a point is, regardless of direction
//   contains(s, p, v, tol)       whether the point is in the solid once it has moved on along v;
//                                reads the components of v only, not its reciprocals
//   distance_to_in(s, p, v, tol) path to the first crossing from outside to inside, or infinity
//   distance_to_out(s, p, v, tol) path to the first crossing from inside to outside
//   safety_to_in(s, p), safety_to_out(s, p)  lower bounds of the distance to the surface, >= 0
// Lengths are in mm, in the frame of the solid. Points within `tol` of a face, measured across it,
// are on the face, and there the direction decides. No kernel moves a point, and no kernel calls a
// transcendental function: results depend on +, -, *, / and square root alone, so that every
// compiler gives the same bits.
//
// Many functions that return or change a span, a point or a direction are inlined by force,
// together with the functions that they call: otherwise compilers pass these values through memory.
namespace navjit::kernels {

enum class Side : int { outside = 0, surface = 1, inside = 2 };

template <class Real>
constexpr Real infinity() {
  return static_cast<Real>(__builtin_inf());
}

template <class Real>
inline Real square_root(Real x) {
  // Numbers beyond the range of double are scaled into that range first.
  const Real large = Real(0x1p600) * Real(0x1p600);
  if (x > 0 && x < Real(0x1p-900)) return square_root(x * large) / Real(0x1p600);
  if (x > Real(0x1p900) && x < x * 2) return square_root(x / large) * Real(0x1p600);
  // Newton's iteration from the double result. Two steps reach 128-bit precision.
  Real root = static_cast<Real>(__builtin_sqrt(static_cast<double>(x)));
  if (!(root > 0)) return root;
  root = (root + x / root) / 2;
  return (root + x / root) / 2;
}
template <>
inline double square_root<double>(double x) {
  return __builtin_sqrt(x);
}
template <>
inline float square_root<float>(float x) {
  return __builtin_sqrtf(x);
}

template <class Real>
constexpr Real absolute(Real x) {
  return x < 0 ? -x : x;
}
template <>
constexpr double absolute<double>(double x) {
  return __builtin_fabs(x);
}

/// The larger of the two; `b` if either is not a number. The order of the arguments matters for
/// that.
template <class Real>
constexpr Real larger(Real a, Real b) {
  return a > b ? a : b;
}
/// The smaller of the two; `b` if either is not a number.
template <class Real>
constexpr Real smaller(Real a, Real b) {
  return a < b ? a : b;
}
/// `magnitude` (>= 0) with the sign of `sign`; positive for zero.
template <class Real>
constexpr Real with_sign(Real magnitude, Real sign) {
  return sign < 0 ? -magnitude : magnitude;
}
template <>
constexpr double with_sign<double>(double magnitude, double sign) {
  return __builtin_copysign(magnitude, sign);
}

template <class Real>
constexpr Vec3<Real> advance(const Vec3<Real>& p, const Direction<Real>& v, Real t) {
  return {p.x + t * v.x, p.y + t * v.y, p.z + t * v.z};
}

/// A direction without its reciprocals, which are not numbers. It is enough for `contains`, which
/// reads the components only.
template <class Real>
constexpr Direction<Real> make_heading(Real x, Real y, Real z) {
  const Real not_given = static_cast<Real>(__builtin_nan(""));
  return {x + Real(0), y + Real(0), z + Real(0), not_given, not_given, not_given};
}

/// A direction whose product with a unit normal is no larger than this runs along the face.
template <class Real>
constexpr Real along_a_face() {
  return static_cast<Real>(0x1p-50);
}
/// Does a direction run along a face? `nv` is the outward unit normal times the direction. The
/// limit allows for the rounding of directions and frames: over a path as long as the world such a
/// ray stays within the tolerance of where it is. If it starts on the face, it is in the solid.
template <class Real>
constexpr bool is_along(Real nv) {
  return absolute(nv) <= along_a_face<Real>();
}

/// Does a direction hardly cross the planes of an axis, given its component along the axis? Within
/// a layer that is as thin as the tolerance it may then go far.
template <class Real>
constexpr bool is_nearly_across(Real component) {
  return absolute(component) <= static_cast<Real>(0x1p-20);
}

/// Does a direction run well away from all coordinate planes of its frame? It may run along other
/// faces.
template <class Real>
constexpr bool is_oblique(const Direction<Real>& v) {
  return !is_nearly_across(smaller(absolute(v.x), smaller(absolute(v.y), absolute(v.z))));
}

/// The verdict on one face for `contains`: `s` is the signed distance of the point beyond the face
/// (> 0 outside), `nv` the outward unit normal times the direction. There are no branches, because
/// processors cannot predict the answer where tracks cross faces.
template <class Real>
constexpr bool beyond_face(Real s, Real nv, Real tol) {
  return (s > tol) | ((s >= -tol) & (nv > along_a_face<Real>()));
}

/// The verdict on one face for `inside`, combined with the verdict `side` on the faces before.
template <class Real>
constexpr Side worse(Side side, Real s, Real tol) {
  if (s > tol) return Side::outside;
  if (s >= -tol && side == Side::inside) return Side::surface;
  return side;
}
constexpr Side worse(Side a, Side b) { return a < b ? a : b; }

// The next two functions are for callers that treat rare cases elsewhere. Solids with a faster
// kernel for the common case overload them.

/// distance_to_in for a direction that is_oblique. The overloads of solids return a negative number
/// if the solid contains the start.
template <class Real, class Solid>
Real distance_to_entry(const Solid& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  return distance_to_in(s, p, v, tol);
}
/// distance_to_out for a direction that is_oblique.
template <class Real, class Solid>
Real distance_to_exit(const Solid& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  return distance_to_out(s, p, v, tol);
}

}  // namespace navjit::kernels
