// The navigation stack: the touchable that a track is in, with every level above it and each
// level's frame. Freestanding: the layout is shared by the generic navigator and by generated code,
// and is part of their binary interface (abi_version).
// Needs vectors.h before it.
#ifndef NAVJIT_DETAIL_NAVIGATION_STACK_H
#define NAVJIT_DETAIL_NAVIGATION_STACK_H
namespace navjit::kernels {

constexpr unsigned abi_version = 14;
constexpr int stack_levels = 64;

/// One level: a placed volume and its frame in the world, local = rotation * (global -
/// translation).
struct StackLevel {
  double translation[3];
  const double* rotation;  ///< null: identity; else `own_rotation` of this or an outer level
  unsigned long long touchable;
  unsigned volume;
  unsigned daughter;  ///< index of the placement in the mother; 0 for the world
  double own_rotation[9];
  double unused;  ///< rounds the size up to a power of two
};
static_assert(sizeof(StackLevel) == 128);

/// The ray along which steps are made: its direction with reciprocals, kept because all its steps
/// share them.
struct RayConstants {
  double given[3] = {0, 0, 0};  ///< as the caller gave it
  Direction<double> direction = make_direction<double>(0, 0, 0);
  bool oblique = false;  ///< is_oblique(direction)
};

/// The direction of the ray in a frame whose rotation all touchables of a volume share; specialised
/// navigators keep it.
struct TurnedRay {
  Direction<double> direction = make_direction<double>(0, 0, 0);
  unsigned rotation = 0;  ///< FrameFacts::rotation; 0: none since the ray began
  bool oblique = false;
};

/// A daughter that the ray in the innermost volume has left for good: the ray came out through a
/// face that bounds the daughter's convex hull, and would have to turn round to meet it again.
/// Specialised navigators keep this, to ask one daughter less.
struct LeftForGood {
  static constexpr unsigned none = ~0U;
  double at[3] = {0, 0, 0};       ///< where it was left, mm, in the world
  unsigned long long mother = 0;  ///< the touchable that it is a daughter of
  unsigned daughter = none;
  int from = -1;  ///< depth of the level whose own end was the last step's; -1: not known
};

/// The boxes of a mother's daughters that the ray meets, as a search found them once: the next
/// steps of the ray in that mother need not look for them again. Specialised navigators keep this.
struct BoxesAhead {
  static constexpr unsigned room = 32;  ///< blocks of eight boxes; a guess
  const void* search = nullptr;         ///< the search that found them; null: nothing is known
  unsigned long long mother = 0;        ///< the touchable
  double at[3] = {0, 0, 0};             ///< where the ray was then, mm, in the mother's frame
  double until = 0;                     ///< the path, mm, up to which all boxes are here
  unsigned count = 0;                   ///< the number of blocks
  unsigned keys[room][8];               ///< as ScanKeys has them
  float leave[room][8];                 ///< the path to where the ray leaves the box, at most
};

/// Must not be copied byte by byte: rotations point into the stack itself.
struct NavigationStack {
  int depth;     ///< index of the innermost level; -1 outside the world
  int boundary;  ///< whether the last step ended on a boundary
  RayConstants ray;
  TurnedRay turned;
  LeftForGood left;
  BoxesAhead* boxes_ahead = nullptr;  ///< two, for even and odd depths; null: none are kept
  StackLevel levels[stack_levels];
};

struct Context;

// The direction of steps, and of the relocation after them, is the stack's ray (set_ray). It is in
// memory, since a call would have to save every register that it took. `data` is
// DispatchEntry::data; for safeties it is DispatchEntry::safety_data.

/// A step from the global point (x, y, z), at most `limit` long. Returns its length and leaves the
/// stack at the next touchable. A negative result: this navigator does not take the state, and the
/// stack is unchanged.
using StepFunction = double (*)(NavigationStack*, const Context*, const void* data, double x,
                                double y, double z, double limit);
/// The point has just come into the innermost level: either from outside (blocked < 0), and then it
/// is known to be in it; or out of its daughter `blocked`, and then it may have to leave this
/// level, too. Brings the stack to the deepest touchable that holds the point.
using RelocateFunction = void (*)(NavigationStack*, const Context*, const void* data, double x,
                                  double y, double z, int blocked);

/// A lower bound (mm, >= 0) of the distance from a global point to the nearest boundary of the
/// innermost volume or of its daughters. It is no more than `enough` (mm, >= 0), since what is
/// farther away need not be looked at.
using SafetyFunction = double (*)(const NavigationStack*, const Context*, const void* data,
                                  double x, double y, double z, double enough);

/// A step of length zero: at the global point the innermost volume ends, and the ray heads out of
/// it. Brings the stack to the next touchable, and notes the boundary.
using LeaveFunction = void (*)(NavigationStack*, const Context*, double x, double y, double z);

/// The global point is in the innermost volume, perhaps on the surface of the daughter that was
/// left last, and the ray may head back into that. If so, makes that step of length zero, and
/// returns its length. Negative if it is not so, or not known; then the touchable is unchanged.
using ReturnFunction = double (*)(NavigationStack*, const Context*, double x, double y, double z);

/// What navigates one volume: immutable, published by one atomic pointer.
struct DispatchEntry {
  StepFunction step;
  RelocateFunction relocate;
  SafetyFunction safety;
  /// The numbers of the scene that are not in the code; null: there are none.
  const void* data = nullptr;
  /// The same for the safety, which another navigator may compute than the one that makes steps.
  const void* safety_data = nullptr;
};

/// What navigators need besides the stack; generated code reaches everything through it.
struct Context {
  const DispatchEntry* const* table;  ///< by volume; entries change while threads run
  const void* geometry;               ///< the generic navigator's data
  LeaveFunction leave_at_once;
  ReturnFunction return_at_once;
  /// By volume: the volumes of its daughters, in order. It serves code that several volumes share
  /// although their daughters differ; null where there is no such code.
  const unsigned* const* daughters = nullptr;
};

/// The dispatch entry of a volume, as another thread has published it.
inline const DispatchEntry* dispatch_entry_of(const Context* context, unsigned volume) {
  return __atomic_load_n(context->table + volume, __ATOMIC_ACQUIRE);
}

/// Relocates in a volume by the navigator that the table has for it; see RelocateFunction.
inline void relocate_in_table(NavigationStack* stack, const Context* context, unsigned volume,
                              double x, double y, double z, int blocked) {
  const DispatchEntry* entry = dispatch_entry_of(context, volume);
  entry->relocate(stack, context, entry->data, x, y, z, blocked);
}

/// Whether the bits are equal. Cheaper than equal values, and enough for what only saves work.
inline bool same_bits(double a, double b) {
  return __builtin_bit_cast(unsigned long long, a) == __builtin_bit_cast(unsigned long long, b);
}

}  // namespace navjit::kernels
#endif
