// What navigators do with the navigation stack (navjit/detail/navigation_stack.h). This text is
// freestanding.
namespace navjit::kernels {

// Frames are applied and composed by canonical formulas (docs/numerics.md), so that all navigators
// get the same bits. Compilers remove the branches where the arguments are constants.

inline Vec3<double> to_local(const StackLevel& level, double x, double y, double z) {
  const double dx = x - level.translation[0], dy = y - level.translation[1],
               dz = z - level.translation[2];
  if (level.rotation == nullptr) return {dx, dy, dz};
  const double* r = level.rotation;
  return {r[0] * dx + r[1] * dy + r[2] * dz, r[3] * dx + r[4] * dy + r[5] * dz,
          r[6] * dx + r[7] * dy + r[8] * dz};
}

inline Direction<double> to_local_direction(const StackLevel& level, double u, double v, double w) {
  if (level.rotation == nullptr) return make_direction<double>(u, v, w);
  const double* r = level.rotation;
  return make_direction<double>(r[0] * u + r[1] * v + r[2] * w, r[3] * u + r[4] * v + r[5] * w,
                                r[6] * u + r[7] * v + r[8] * w);
}

/// The same without reciprocals, for callers that only ask whether a point is contained.
inline Direction<double> to_local_heading(const StackLevel& level, double u, double v, double w) {
  if (level.rotation == nullptr) return make_heading<double>(u, v, w);
  const double* r = level.rotation;
  return make_heading<double>(r[0] * u + r[1] * v + r[2] * w, r[3] * u + r[4] * v + r[5] * w,
                              r[6] * u + r[7] * v + r[8] * w);
}

/// Must be called before steps along (u, v, w).
inline void set_ray(NavigationStack& stack, double u, double v, double w) {
  RayConstants& ray = stack.ray;
  if (same_bits(ray.given[0], u) && same_bits(ray.given[1], v) && same_bits(ray.given[2], w)) {
    return;
  }
  ray.given[0] = u;
  ray.given[1] = v;
  ray.given[2] = w;
  ray.direction = make_direction<double>(u, v, w);
  ray.oblique = is_oblique(ray.direction);
  stack.turned.rotation = 0;
  stack.left.daughter = LeftForGood::none;
  stack.left.from = -1;
  if (stack.boxes_ahead != nullptr) {
    stack.boxes_ahead[0].search = nullptr;
    stack.boxes_ahead[1].search = nullptr;
  }
}

/// The daughter of the innermost level that the stack's ray is known not to meet again from this
/// point; LeftForGood::none if none is known. The point may differ by a quarter of the tolerance
/// from that where the daughter was left, because callers may compute it with another last bit.
inline unsigned left_for_good(const NavigationStack& stack, double x, double y, double z,
                              double tol) {
  const LeftForGood& left = stack.left;
  const double off =
      larger(absolute(x - left.at[0]), larger(absolute(y - left.at[1]), absolute(z - left.at[2])));
  const bool is_here = (left.mother == stack.levels[stack.depth].touchable) & (off <= 0.25 * tol);
  return is_here ? left.daughter : LeftForGood::none;
}

/// The stack's ray in a frame with the rotation of this number. turn() computes the direction. It
/// is not called again if the last rotated frame had the same rotation.
template <class Turn>
inline const TurnedRay& turned_ray(NavigationStack* stack, unsigned rotation, Turn turn) {
  TurnedRay& turned = stack->turned;
  if (__builtin_expect(turned.rotation != rotation, 0)) {
    turned.rotation = rotation;
    turned.direction = turn();
    turned.oblique = is_oblique(turned.direction);
  }
  return turned;
}

/// Pushes a daughter that is placed by translation only.
inline void push_translated(NavigationStack* stack, unsigned volume, unsigned daughter,
                            unsigned long long offset, double tx, double ty, double tz) {
  const StackLevel& mother = stack->levels[stack->depth];
  StackLevel& level = stack->levels[++stack->depth];
  if (mother.rotation == nullptr) {
    level.translation[0] = mother.translation[0] + tx;
    level.translation[1] = mother.translation[1] + ty;
    level.translation[2] = mother.translation[2] + tz;
  } else {
    const double* r = mother.rotation;
    level.translation[0] = mother.translation[0] + (r[0] * tx + r[3] * ty + r[6] * tz);
    level.translation[1] = mother.translation[1] + (r[1] * tx + r[4] * ty + r[7] * tz);
    level.translation[2] = mother.translation[2] + (r[2] * tx + r[5] * ty + r[8] * tz);
  }
  level.rotation = mother.rotation;
  level.touchable = mother.touchable + offset;
  level.volume = volume;
  level.daughter = daughter;
}

/// Pushes a daughter that is placed with a rotation.
inline void push_rotated(NavigationStack* stack, unsigned volume, unsigned daughter,
                         unsigned long long offset, double tx, double ty, double tz,
                         const double* rotation) {
  push_translated(stack, volume, daughter, offset, tx, ty, tz);
  StackLevel& level = stack->levels[stack->depth];
  const double* outer = level.rotation;
  double* own = level.own_rotation;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double* q = rotation + 3 * i;
      own[3 * i + j] =
          outer == nullptr ? q[j] : q[0] * outer[j] + q[1] * outer[3 + j] + q[2] * outer[6 + j];
    }
  }
  level.rotation = own;
}

}  // namespace navjit::kernels
