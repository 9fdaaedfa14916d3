// Triangles, eight at once, and which of them the line of a ray may cross.
namespace navjit::kernels {

/// Coordinates along and across a ray. They are sheared, so that x = y = 0 along the ray.
template <class Real>
struct RayFrame {
  Vec3<Real> start;
  int axis;  ///< the axis along which the ray moves most
  Real shear_x, shear_y, rate;
};

template <class Real>
constexpr Vec3<Real> turned(const Vec3<Real>& p, int axis) {
  return axis == 0 ? Vec3<Real>{p.y, p.z, p.x} : axis == 1 ? Vec3<Real>{p.z, p.x, p.y} : p;
}
template <class Real>
RayFrame<Real> ray_frame(const Vec3<Real>& p, const Direction<Real>& v) {
  const Real x = absolute(v.x), y = absolute(v.y), z = absolute(v.z);
  const int axis = x > y ? (x > z ? 0 : 2) : (y > z ? 1 : 2);
  const Vec3<Real> d = turned(Vec3<Real>{v.x, v.y, v.z}, axis);
  return {p, axis, d.x / d.z, d.y / d.z, d.z};
}

/// One corner of each of eight triangles.
template <class Real>
struct EightCorners {
  EightOf<Real> x, y, z;
};

/// Up to eight facets that follow one another. In an empty lane all corners are at the same place.
template <class Real>
struct FacetLeaf {
  EightCorners<Real> a, b, c;
  int first;
};

/// Coordinates across a ray, measured from the ray.
struct LanesAcross {
  EightLanes x, y;
};
inline LanesAcross lanes_across(const EightCorners<double>& corners,
                                const RayFrame<double>& frame) {
  const EightOf<double>* const by_axis[3] = {&corners.x, &corners.y, &corners.z};
  const double start[3] = {frame.start.x, frame.start.y, frame.start.z};
  // The same order of axes as in turned().
  const int x = frame.axis == 2 ? 0 : frame.axis + 1, y = x == 2 ? 0 : x + 1;
  const EightLanes along = lanes_from(*by_axis[frame.axis]) - start[frame.axis];
  return {lanes_from(*by_axis[x]) - start[x] - frame.shear_x * along,
          lanes_from(*by_axis[y]) - start[y] - frame.shear_y * along};
}

/// The lanes whose triangles the line may cross. These are all for which facet_turn() says so, and
/// hardly any others.
///
/// An edge that reaches from one side of y = 0 to the other crosses it at x =
/// (x0 y1 - x1 y0) / (y1 - y0). With u = 2^-53, what facet_turn() computes for x is off by less
/// than 5u (|x0| + |x1|), and the numerator that is computed here is off by 3u (|x0| + |x1|) (|y0|
/// + |y1|). If the numerator is farther from 0 than 90u (|x0| + |x1|) (|y0| + |y1|), both have the
/// same sign. A triangle is left out if these signs tell that it crosses y = 0 on one side of the
/// ray only.
inline unsigned lanes_crossed(const FacetLeaf<double>& leaf, const RayFrame<double>& frame) {
  const LanesAcross at[3] = {lanes_across(leaf.a, frame), lanes_across(leaf.b, frame),
                             lanes_across(leaf.c, frame)};
  EightWords above[3];
  for (int i = 0; i < 3; ++i) above[i] = __builtin_bit_cast(EightWords, at[i].y > 0);
  EightWords anticlockwise{}, clockwise{}, any{};
  for (int i = 0; i < 3; ++i) {
    const int k = i == 2 ? 0 : i + 1;
    const EightWords reaches = above[i] ^ above[k];
    const EightLanes turn = at[i].x * at[k].y - at[k].x * at[i].y;
    const EightLanes unsure =
        1e-14 * (absolute(at[i].x) + absolute(at[k].x)) * (absolute(at[i].y) + absolute(at[k].y)) +
        1e-300;
    anticlockwise |= reaches & __builtin_bit_cast(EightWords, turn > unsure);
    clockwise |= reaches & __builtin_bit_cast(EightWords, turn < -unsure);
    any |= reaches;
  }
  return bits_of(any & ~(anticlockwise & clockwise));
}

}  // namespace navjit::kernels
