// Boxes of a hierarchy around triangles, tested eight at once, down to leaves of eight triangles.
namespace navjit::kernels {

/// Boxes around leaves and around further groups; empty lanes have low above high.
template <class Real>
struct FacetGroup {
  EightOf<Real> x_low, y_low, z_low, x_high, y_high, z_high;
  EightOf<int> below;  ///< by lane: the number of a group, or -1 minus the number of a leaf
};

/// More than can wait: at most seven groups on each level, and there are at most most_facet_levels
/// levels.
constexpr int most_waiting_groups = 256;

/// A ray in all lanes. The margin of the boxes is applied to its start, which is moved ahead by the
/// margin for the faces by which it enters boxes, and back for those by which it leaves them.
struct FacetRay {
  EightLanes before[3], after[3], inverse[3];
  bool down[3];
};

inline FacetRay facet_ray(const Vec3<double>& p, const Direction<double>& v, double margin) {
  const bool down[3] = {v.x < 0, v.y < 0, v.z < 0};
  const double at[3] = {p.x, p.y, p.z};
  FacetRay ray{{}, {}, {eight_of(v.inverse_x), eight_of(v.inverse_y), eight_of(v.inverse_z)}, {}};
  for (int axis = 0; axis < 3; ++axis) {
    ray.before[axis] = eight_of(down[axis] ? at[axis] - margin : at[axis] + margin);
    ray.after[axis] = eight_of(down[axis] ? at[axis] + margin : at[axis] - margin);
    ray.down[axis] = down[axis];
  }
  return ray;
}

/// The lanes whose boxes the ray may meet, from its start on. For a ray along a plane of the boxes
/// the reciprocal is infinite. Its product with 0, on the very edge, is NaN and clips nothing.
inline unsigned lanes_met(const FacetGroup<double>& g, const FacetRay& ray) {
  const EightOf<double>* const low[3] = {&g.x_low, &g.y_low, &g.z_low};
  const EightOf<double>* const high[3] = {&g.x_high, &g.y_high, &g.z_high};
  EightLanes enter = eight_of(0);
  EightLanes leave = enter + infinity<double>();
  for (int axis = 0; axis < 3; ++axis) {
    const EightOf<double>& near = ray.down[axis] ? *high[axis] : *low[axis];
    const EightOf<double>& far = ray.down[axis] ? *low[axis] : *high[axis];
    const EightLanes first = (lanes_from(near) - ray.before[axis]) * ray.inverse[axis];
    const EightLanes last = (lanes_from(far) - ray.after[axis]) * ray.inverse[axis];
    enter = first > enter ? first : enter;
    leave = last < leave ? last : leave;
  }
  return bits_of(__builtin_bit_cast(EightWords, enter <= leave));
}

/// Calls visit(triangle) for the triangles that the ray's line may cross, in leaves whose boxes the
/// ray, which is along `v`, may come within `margin` of.
template <class Visit>
inline void visit_met(const FacetGroup<double>* groups, const FacetLeaf<double>* leaves,
                      const RayFrame<double>& frame, const Direction<double>& v, double margin,
                      const Visit& visit) {
  const FacetRay ray = facet_ray(frame.start, v, margin);
  int waiting[most_waiting_groups];
  int count = 0;
  for (int at = 0;;) {
    const FacetGroup<double>& group = groups[at];
    int below[8];
    __builtin_memcpy(below, &group.below, sizeof below);
    for (unsigned lanes = lanes_met(group, ray); lanes != 0; lanes &= lanes - 1) {
      const int next = below[__builtin_ctz(lanes)];
      if (next >= 0) {
        waiting[count++] = next;
        continue;
      }
      const FacetLeaf<double>& leaf = leaves[-1 - next];
      for (unsigned crossed = lanes_crossed(leaf, frame); crossed != 0; crossed &= crossed - 1) {
        visit(leaf.first + __builtin_ctz(crossed));
      }
    }
    if (count == 0) return;
    at = waiting[--count];
  }
}

}  // namespace navjit::kernels
