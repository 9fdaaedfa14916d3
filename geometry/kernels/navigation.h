// The navigation stack: the touchable that a track is in, with every level above it and each
// level's frame. The layout is shared by the generic navigator and by generated code, and is part
// of their binary interface (abi_version).
namespace navjit::kernels {

constexpr unsigned abi_version = 5;
constexpr int stack_levels = 64;

/// One level: a placed volume and its frame in the world, local = rotation * (global -
/// translation).
struct StackLevel {
  double translation[3];
  const double* rotation;  ///< null: identity. Points to `own_rotation` of this or an outer level
  unsigned long long touchable;
  unsigned volume;
  unsigned daughter;  ///< index of the placement in the mother; 0 for the world
  double own_rotation[9];
  double unused;  ///< rounds the size up to a power of two
};
static_assert(sizeof(StackLevel) == 128);

/// The ray that steps are made along: its direction with reciprocals, kept because its steps share
/// it.
struct RayConstants {
  double given[3] = {0, 0, 0};  ///< as the caller gave it
  Direction<double> direction = make_direction<double>(0, 0, 0);
  bool oblique = false;  ///< is_oblique(direction)
};

/// The same in a frame whose rotation all touchables of a volume share; specialised navigators keep
/// it.
struct TurnedRay {
  Direction<double> direction = make_direction<double>(0, 0, 0);
  unsigned rotation = 0;  ///< FrameFacts::rotation; 0: none since the ray began
  bool oblique = false;
};

/// Not copyable by bytes: rotations point into the stack itself.
struct Stack {
  int depth;     ///< index of the innermost level; -1 outside the world
  int boundary;  ///< whether the last step ended on a boundary
  RayConstants ray;
  TurnedRay turned;
  StackLevel levels[stack_levels];
};

struct Context;

// The direction of steps, and of relocation behind them, is the stack's ray (set_ray): in memory it
// takes no registers, all of which a call would have to save. `data` is Navigators::data.

/// A step from the global point (x, y, z) at most `limit` long. Gives its length and leaves the
/// stack at the next touchable. A negative result: this navigator does not take the state; the
/// stack is unchanged.
using StepFunction = double (*)(Stack*, const Context*, const void* data, double x, double y,
                                double z, double limit);
/// The point has just come into the innermost level: from outside (blocked < 0), then it is known
/// to be in it; or out of its daughter `blocked`, then it may have to leave this level too. Brings
/// the stack to the deepest touchable with the point.
using SettleFunction = void (*)(Stack*, const Context*, const void* data, double x, double y,
                                double z, int blocked);

/// A lower bound (mm, >= 0) of the distance from a global point to the nearest boundary of the
/// innermost volume or of its daughters.
using SafetyFunction = double (*)(const Stack*, const Context*, const void* data, double x,
                                  double y, double z);

/// What navigates one volume: immutable, published by one atomic pointer.
struct Navigators {
  StepFunction step;
  SettleFunction settle;
  SafetyFunction safety;
  /// The numbers of the scene, where the code is shared by all scenes of its structure; else null.
  const void* data = nullptr;
};

/// What navigators need besides the stack; generated code reaches everything through it.
struct Context {
  const Navigators* const* table;  ///< by volume; entries change while threads run
  const void* geometry;            ///< the generic navigator's data
};

/// The record of a volume, as other threads published it.
inline const Navigators* navigators_of(const Context* context, unsigned volume) {
  return __atomic_load_n(context->table + volume, __ATOMIC_ACQUIRE);
}

/// Relocation in a volume that the table knows how to navigate: see SettleFunction.
inline void settle_in_table(Stack* stack, const Context* context, unsigned volume, double x,
                            double y, double z, int blocked) {
  const Navigators* navigators = navigators_of(context, volume);
  navigators->settle(stack, context, navigators->data, x, y, z, blocked);
}

// Canonical composition and application; docs/numerics.md has the rules. The branches vanish where
// the arguments are constants.

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

/// The same for what asks only whether a point is contained.
inline Direction<double> to_local_heading(const StackLevel& level, double u, double v, double w) {
  if (level.rotation == nullptr) return make_heading<double>(u, v, w);
  const double* r = level.rotation;
  return make_heading<double>(r[0] * u + r[1] * v + r[2] * w, r[3] * u + r[4] * v + r[5] * w,
                              r[6] * u + r[7] * v + r[8] * w);
}

/// Equal bits: cheaper than equal values, and all the same for what is only kept to save work.
inline bool same_bits(double a, double b) {
  return __builtin_bit_cast(unsigned long long, a) == __builtin_bit_cast(unsigned long long, b);
}

/// To be called before steps along (u, v, w).
inline void set_ray(Stack& stack, double u, double v, double w) {
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
}

/// turn(), the stack's ray in a frame of the rotation of that number, without doing it again where
/// the last step was in such a frame, too.
template <class Turn>
inline const TurnedRay& turned_ray(Stack* stack, unsigned rotation, Turn turn) {
  TurnedRay& turned = stack->turned;
  if (__builtin_expect(turned.rotation != rotation, 0)) {
    turned.rotation = rotation;
    turned.direction = turn();
    turned.oblique = is_oblique(turned.direction);
  }
  return turned;
}

/// Pushes a daughter placed by translation alone.
inline void push_translated(Stack* stack, unsigned volume, unsigned daughter,
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

/// Pushes a daughter placed with a rotation.
inline void push_rotated(Stack* stack, unsigned volume, unsigned daughter,
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
