// Frames and places of daughters whose numbers are constants. Products with zero are left out of
// sums, and so are factors of one. Sums keep their order, and so their bits. Only the sign of a sum
// that is zero may change, and no kernel reads that sign (docs/numerics.md).
namespace navjit::kernels {

/// A number that is known when the code is compiled.
template <double value>
struct ConstantNumber {
  constexpr operator double() const { return value; }
};

/// Stands for a term that is left out of a sum.
struct NoTerm {};

template <double factor>
constexpr auto term(double x) {
  if constexpr (factor == 0) {
    return NoTerm{};
  } else if constexpr (factor == 1) {
    return x;
  } else if constexpr (factor == -1) {
    return -x;
  } else {
    return factor * x;
  }
}
template <double factor>
constexpr NoTerm term(NoTerm) {
  return {};
}
constexpr double plus(double a, double b) { return a + b; }
constexpr double plus(double a, NoTerm) { return a; }
constexpr double plus(NoTerm, double b) { return b; }
constexpr NoTerm plus(NoTerm, NoTerm) { return {}; }
constexpr double value_of(double x) { return x; }
constexpr double value_of(NoTerm) { return 0; }

/// One component of the product of the matrix `by.turn` and a vector.
template <const auto& by, int row>
constexpr double turned_row(double x, double y, double z) {
  return value_of(plus(plus(term<by.turn[3 * row]>(x), term<by.turn[3 * row + 1]>(y)),
                       term<by.turn[3 * row + 2]>(z)));
}
template <const auto& by>
constexpr Vec3<double> turned_by(double x, double y, double z) {
  return {turned_row<by, 0>(x, y, z), turned_row<by, 1>(x, y, z), turned_row<by, 2>(x, y, z)};
}

/// What all touchables of a volume have in common if they have one rotation, or none is rotated.
struct FrameConstants {
  unsigned rotation;      ///< the number of the rotation, as in TurnedRay; 0 if there is none
  double turn[9];         ///< the rotation
  bool placed;            ///< whether the volume has only one touchable
  double translation[3];  ///< where that touchable is in the world, mm
};

template <const auto& known>
struct ConstantFrame {
  static constexpr bool rotated = known.rotation != 0;
  static constexpr const FrameConstants& constants = known;

  static Vec3<double> point(const StackLevel& level, double x, double y, double z) {
    if (rotated != (level.rotation != nullptr)) __builtin_unreachable();
    const double* const t = known.placed ? known.translation : level.translation;
    const double dx = x - t[0], dy = y - t[1], dz = z - t[2];
    if constexpr (rotated) {
      return turned_by<known>(dx, dy, dz);
    } else {
      return {dx, dy, dz};
    }
  }
  static const Direction<double>& ray(NavigationStack* stack, const StackLevel&) {
    if constexpr (rotated) {
      return turned_ray(stack, known.rotation,
                        [&] {
                          const double* v = stack->ray.given;
                          const Vec3<double> u = turned_by<known>(v[0], v[1], v[2]);
                          return make_direction<double>(u.x, u.y, u.z);
                        })
          .direction;
    } else {
      return stack->ray.direction;
    }
  }
  /// The ray's direction in this frame. The reciprocals in it are not valid.
  static Direction<double> heading(const NavigationStack* stack, const StackLevel&) {
    if constexpr (rotated) {
      if (stack->turned.rotation == known.rotation) {
        const Direction<double>& v = stack->turned.direction;
        return make_heading<double>(v.x, v.y, v.z);
      }
      const double* v = stack->ray.given;
      const Vec3<double> u = turned_by<known>(v[0], v[1], v[2]);
      return make_heading<double>(u.x, u.y, u.z);
    } else {
      const Direction<double>& v = stack->ray.direction;
      return {v.x, v.y, v.z, v.x, v.x, v.x};
    }
  }
  static bool oblique(const NavigationStack* stack, const StackLevel&, const Direction<double>&) {
    return rotated ? stack->turned.oblique : stack->ray.oblique;
  }
};

/// What the places of several daughters have in common. Arrays are by axis.
struct PlaceConstants {
  bool same[3];  ///< whether all daughters have the same coordinate
  double at[3];  ///< the coordinate that all have, mm
  bool rotated;  ///< whether all daughters are rotated; if not, none is
  bool same_turn;
  double turn[9];  ///< the rotation of all daughters, if same_turn
  bool same_volume;
  unsigned volume;
};

/// A coordinate of a daughter's place.
template <const auto& shared, int axis>
constexpr double coordinate(double own) {
  return shared.same[axis] ? shared.at[axis] : own;
}
/// The coordinate as a term of a sum. There is no such term if the coordinate of all daughters is
/// zero.
template <const auto& shared, int axis>
constexpr auto moved(double own) {
  if constexpr (shared.same[axis] && shared.at[axis] == 0) {
    return NoTerm{};
  } else {
    return coordinate<shared, axis>(own);
  }
}

/// One world component of the vector (x, y, z) that is given in a frame. Some of x, y and z may be
/// terms that are left out.
template <const auto& frame, int axis, class X, class Y, class Z>
constexpr auto moved_in_frame(X x, Y y, Z z) {
  if constexpr (frame.rotation != 0) {
    return plus(plus(term<frame.turn[axis]>(x), term<frame.turn[3 + axis]>(y)),
                term<frame.turn[6 + axis]>(z));
  } else if constexpr (axis == 0) {
    return x;
  } else if constexpr (axis == 1) {
    return y;
  } else {
    return z;
  }
}

/// Pushes a daughter that is placed by translation only. `shared` is the PlaceConstants of all
/// daughters of the scene.
template <class Frame, const auto& shared>
inline void push_placed(NavigationStack* stack, unsigned volume, unsigned daughter,
                        unsigned long long offset, double x, double y, double z) {
  if constexpr (requires { Frame::constants; }) {
    const StackLevel& mother = stack->levels[stack->depth];
    StackLevel& level = stack->levels[++stack->depth];
    const auto tx = moved<shared, 0>(x);
    const auto ty = moved<shared, 1>(y);
    const auto tz = moved<shared, 2>(z);
    constexpr const FrameConstants& frame = Frame::constants;
    level.translation[0] = plus(mother.translation[0], moved_in_frame<frame, 0>(tx, ty, tz));
    level.translation[1] = plus(mother.translation[1], moved_in_frame<frame, 1>(tx, ty, tz));
    level.translation[2] = plus(mother.translation[2], moved_in_frame<frame, 2>(tx, ty, tz));
    level.rotation = Frame::rotated ? mother.rotation : nullptr;
    level.touchable = mother.touchable + offset;
    level.volume = shared.same_volume ? shared.volume : volume;
    level.daughter = daughter;
  } else {
    if (!Frame::rotated && stack->levels[stack->depth].rotation != nullptr) {
      __builtin_unreachable();
    }
    push_translated(stack, volume, daughter, offset, x, y, z);
  }
}

}  // namespace navjit::kernels
