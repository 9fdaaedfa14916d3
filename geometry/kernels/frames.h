// How a point and the ray are transformed into the frame of a scene. What the frames of all
// touchables of a volume have in common is expressed by a type, so that the code for a simple frame
// handles no other case.
namespace navjit::kernels {

/// No touchable of the volume is rotated in the world.
struct UnrotatedFrame {
  static constexpr bool rotated = false;

  Vec3<double> point(const StackLevel& level, double x, double y, double z) const {
    return {x - level.translation[0], y - level.translation[1], z - level.translation[2]};
  }
  const Direction<double>& ray(NavigationStack* stack, const StackLevel&) const {
    return stack->ray.direction;
  }
  const Direction<double>& heading(const NavigationStack* stack, const StackLevel&) const {
    return stack->ray.direction;
  }
  /// is_oblique(v), v being the ray in this frame.
  bool oblique(const NavigationStack* stack, const StackLevel&, const Direction<double>&) const {
    return stack->ray.oblique;
  }
};

/// All touchables have the same rotation in the world, which is not the identity. The ray's
/// direction in this frame is kept from step to step.
struct TurnedFrame {
  static constexpr bool rotated = true;
  unsigned rotation;  ///< its number, as in TurnedRay; not 0

  Vec3<double> point(const StackLevel& level, double x, double y, double z) const {
    if (level.rotation == nullptr) __builtin_unreachable();
    return to_local(level, x, y, z);
  }
  const Direction<double>& ray(NavigationStack* stack, const StackLevel& level) const {
    if (level.rotation == nullptr) __builtin_unreachable();
    const double* v = stack->ray.given;
    return turned_ray(stack, rotation, [&] { return to_local_direction(level, v[0], v[1], v[2]); })
        .direction;
  }
  Direction<double> heading(const NavigationStack* stack, const StackLevel& level) const {
    if (level.rotation == nullptr) __builtin_unreachable();
    if (stack->turned.rotation == rotation) return stack->turned.direction;
    const double* v = stack->ray.given;
    return to_local_heading(level, v[0], v[1], v[2]);
  }
  bool oblique(const NavigationStack* stack, const StackLevel&, const Direction<double>&) const {
    return stack->turned.oblique;
  }
};

/// The touchables have different rotations. Some may have none.
struct AnyFrame {
  static constexpr bool rotated = true;

  Vec3<double> point(const StackLevel& level, double x, double y, double z) const {
    return to_local(level, x, y, z);
  }
  Direction<double> ray(NavigationStack* stack, const StackLevel& level) const {
    if (level.rotation == nullptr) return stack->ray.direction;
    const double* v = stack->ray.given;
    return to_local_direction(level, v[0], v[1], v[2]);
  }
  Direction<double> heading(const NavigationStack* stack, const StackLevel& level) const {
    if (level.rotation == nullptr) return stack->ray.direction;
    const double* v = stack->ray.given;
    return to_local_heading(level, v[0], v[1], v[2]);
  }
  bool oblique(const NavigationStack* stack, const StackLevel& level,
               const Direction<double>& v) const {
    return level.rotation == nullptr ? stack->ray.oblique : is_oblique(v);
  }
};

}  // namespace navjit::kernels
