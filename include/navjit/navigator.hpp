// One thread's view of the geometry.
#pragma once

#include <limits>
#include <memory>
#include <span>

#include "navjit/detail/api.hpp"
#include "navjit/detail/profile.hpp"
#include "navjit/detail/read_side.hpp"
#include "navjit/detail/unit_direction.hpp"
#include "navjit/errors.hpp"
#include "navjit/state.hpp"
#include "navjit/transformation.hpp"

// clang-format off: after the vectors
#include "navjit/detail/navigation_stack.h"
// clang-format on

namespace NAVJIT_API navjit {

namespace detail {
struct Shared;  ///< what a Runtime and its navigators share
}

/// What one navigator has counted, beside its profile.
struct NavigatorCounts {
  std::uint64_t bail_outs = 0;      ///< states that a specialised navigator did not take
  std::uint64_t differences = 0;    ///< shadow mode: answers that were not the generic one's
  std::uint64_t restored = 0;       ///< states that were not the last one returned
  std::uint64_t within_safety = 0;  ///< steps that stayed in the ball of the last safety
};

/// Answers where a point is, how far it is to the next boundary, and what comes after that. One per
/// thread; it keeps the runtime's data alive. Points and directions are global and have to be
/// finite; directions of steps have to be of unit length (to 1e-5). States are good in any
/// navigator of their world. What breaks these rules is answered by UsageError, and the navigator
/// stays as good as it was. One that was moved from may only be destroyed.
class Navigator {
 public:
  Navigator(Navigator&&) noexcept = default;
  Navigator& operator=(Navigator&&) = delete;
  ~Navigator();

  /// The deepest touchable that holds the point, or outside. On a face that volumes share it is the
  /// first of them in file order; where volumes overlap, the last. Throws UsageError if a
  /// coordinate is not finite.
  State locate(const Vec3& point);
  /// As above; on a face the direction decides.
  State locate(const Vec3& point, const Vec3& direction);

  /// One step from `point` in `state`, at most `limit` mm; limits of 0 and of infinity are allowed.
  /// Throws UsageError if the state is outside the world or of another world, if the point is not
  /// finite, if the direction is not a unit vector, or if the limit is negative or not a number. (A
  /// state of another world is not recognised if its touchable and volume have the same numbers as
  /// those of a state of this world; then it is taken for that state.)
  ///
  /// If the step stays in the ball of the last safety() that was asked in the same state, its
  /// length is the limit, and no geometry is looked at. Most steps of particles that scatter do so.
  Step step(const State& state, const Vec3& point, const Vec3& direction,
            double limit = std::numeric_limits<double>::infinity());

  /// All steps of a straight ray in one call, for rays that only look (pictures, scans of
  /// materials): from boundary to boundary until the ray leaves the world, until `limit` mm are
  /// covered in all, or until the buffer is full. Returns the steps that were made, at the front of
  /// the buffer; there is at least one. Each is, bit for bit, the step() from the end of the one
  /// before it, with `point = point + length * direction`, number by number, and `limit = limit -
  /// length`. The point and the limit are moved on to the end of the last step, so that the same
  /// call with its `next` continues the ray. Throws as step() does, and UsageError if the buffer is
  /// empty; then nothing was moved.
  std::span<Step> steps(const State& state, Vec3& point, const Vec3& direction, double& limit,
                        std::span<Step> buffer);

  /// A lower bound of the distance to the nearest boundary, mm; `enough` if that is less. Throws
  /// UsageError if the state is outside the world or of another world, if a coordinate is not
  /// finite, or if `enough` is negative or not a number. The answer depends on the arguments alone,
  /// and is kept for the steps that follow.
  ///
  /// What is farther away than `enough` need not be looked at, so that a small `enough` makes the
  /// call cheap: a caller that wants to know whether a step of some length stays in the volume asks
  /// for that length.
  double safety(const State& state, const Vec3& point,
                double enough = std::numeric_limits<double>::infinity());

  /// As step(), for a caller that has a safety sphere: the length of a step that stays in it is the
  /// limit, and no geometry is looked at. Otherwise the answer is that of step(). Throws as step().
  Step step(const State& state, const Vec3& point, const Vec3& direction, double limit,
            const SafetySphere& sphere) {
    if (sphere.holds(state, point, limit)) return {limit, false, state};
    return step(state, point, direction, limit);
  }

  /// The ball about the point that safety() promises: steps within it need no geometry, and a point
  /// that is displaced within it stays in the state. Throws as safety().
  SafetySphere safety_sphere(const State& state, const Vec3& point,
                             double enough = std::numeric_limits<double>::infinity()) {
    return {state, point, safety(state, point, enough)};
  }

  /// The deepest touchable that holds a point which is in the hint, or near it: after a
  /// displacement within a volume this costs a look at the volume and its daughters. (A
  /// displacement within the safety needs no call: states hold no point.) As locate(), but where
  /// several touchables hold the point, on faces and in overlaps, it is one of those that are
  /// nearest to the hint in the tree. The hint may be outside the world. Throws UsageError if a
  /// number is not finite or the hint is of another world.
  State relocate(const State& hint, const Vec3& point, const Vec3& direction);

  /// From the world into the state's frame, or into that of its ancestor at a depth (0: the world
  /// volume): the bits that navigation uses. Throws UsageError if there is no such level.
  Transformation frame(const State& state);
  Transformation frame(const State& state, int depth);
  /// Points (mm) and directions into the state's frame and back. All throw UsageError if the state
  /// is outside the world or of another world.
  Vec3 to_local(const State& state, const Vec3& point);
  Vec3 to_global(const State& state, const Vec3& local_point);
  Vec3 direction_to_local(const State& state, const Vec3& direction);
  Vec3 direction_to_global(const State& state, const Vec3& local_direction);

  /// The outward unit normal of the state's volume, in the world's frame, at a point (mm) on its
  /// surface. Near the surface it is that of the nearest face, and on an edge that of the first of
  /// its faces (docs/normals.md). Throws UsageError if the point is not finite, or if the state is
  /// outside the world or of another world.
  Vec3 normal(const State& state, const Vec3& point);
  /// The unit normal of the boundary that a step from `from` ended on, at the end `point` of that
  /// step. It points out of what was left: out of the volume of `from`, or into the daughter of it
  /// that was entered. `next` is Step::next. Throws as normal().
  Vec3 boundary_normal(const State& from, const State& next, const Vec3& point);

  /// For programs that keep paths of their own: the levels from the world volume down to the state
  /// that locate(), relocate(), or a step() that changed the state gave last. Each has its
  /// touchable, its volume, and its number among the mother's daughters. Levels whose touchables
  /// are as before need not be written anew. Empty outside the world. Valid until the next call.
  std::span<const kernels::StackLevel> levels() const {
    return {own_->stack.levels, static_cast<std::size_t>(own_->stack.depth + 1)};
  }

  /// The same for any state. The track stays where it is. Throws UsageError if the state is outside
  /// the world or of another world.
  std::span<const kernels::StackLevel> levels(const State& state);

  /// What this navigator has counted so far.
  const NavigatorCounts& counts() const { return own_->counts; }

 private:
  friend class Runtime;
  friend class Basket;
  struct Own {
    kernels::NavigationStack stack{};
    /// The stack for questions about another state, so that the track stays where it is.
    kernels::NavigationStack aside{};
    kernels::BoxesAhead boxes_ahead[2]{};  ///< those of `stack`
    Profile profile;
    std::shared_ptr<ReadSide> read_side;
    NavigatorCounts counts;
    SafetySphere sphere{};       ///< the ball of the last call of safety()
    std::uint64_t shadowed = 0;  ///< steps made in shadow mode
    explicit Own(std::size_t volumes);
  };

  explicit Navigator(std::shared_ptr<detail::Shared> shared);
  /// Throws UsageError unless the point is finite and the limit is no less than 0.
  static void require_numbers(const Vec3& point, double limit);
  /// Throws UsageError unless the direction is of unit length.
  static void require_unit(const Vec3& direction) {
    if (!detail::is_unit_vector(direction.x, direction.y, direction.z)) [[unlikely]]
      refuse_direction(direction);
  }
  [[noreturn]] static void refuse_direction(const Vec3& direction);
  /// Turns the further steps of the stack to another direction. Throws as require_unit().
  static void begin_ray(kernels::NavigationStack& stack, const Vec3& direction);
  /// Whether specialised navigators may locate a point with this direction: they answer for
  /// directions of unit length only, and the direction becomes the stack's ray.
  bool locates_along(kernels::NavigationStack& stack, const Vec3& direction) const;
  /// The point is in the innermost level: brings the stack down into its daughters.
  void relocate_within(kernels::NavigationStack& stack, const Vec3& point);
  /// The same, recorded for the specialiser.
  void recorded_location(kernels::NavigationStack& stack, const Vec3& point);
  /// Brings the stack to the state. Throws UsageError if the world has no such state.
  void bring(kernels::NavigationStack& stack, const State& state) const;
  /// The same, and counts it.
  void restore(kernels::NavigationStack& stack, const State& state);
  /// The normal of the level's volume, in the world's frame.
  Vec3 normal_in(const kernels::StackLevel& level, const Vec3& point) const;
  void restore_unless_at(const State& state) {
    if (!is_at(own_->stack, state)) restore(own_->stack, state);
  }
  static bool is_at(const kernels::NavigationStack& s, const State& state) {
    return s.depth >= 0 && s.levels[s.depth].touchable == state.touchable() &&
           s.levels[s.depth].volume == state.volume();
  }
  /// Throws UsageError unless the point is finite and `enough` is no less than 0.
  static void require_numbers_of_safety(const Vec3& point, double enough);
  /// The safety, recorded for the specialiser.
  double recorded_safety(const Vec3& point, double enough);
  State locate_in(kernels::NavigationStack& stack, const Vec3& point, const Vec3& direction);
  /// A step of the track that this stack belongs to; the arguments have been checked.
  Step step_of(kernels::NavigationStack& stack, const State& from, const Vec3& point,
               const Vec3& direction, double limit);
  /// As step_of(), for a stack that already has the direction and is at the state.
  Step step_on(kernels::NavigationStack& stack, const Vec3& point, const Vec3& direction,
               double limit);
  /// The step's length, recorded for the specialiser; with shadow mode on, all steps are made here.
  double recorded_step(kernels::NavigationStack& stack, const Vec3& point, const Vec3& direction,
                       double limit);
  double shadow(const kernels::DispatchEntry& entry, kernels::NavigationStack& stack,
                const Vec3& point, const Vec3& direction, double limit);
  double bail_out(kernels::NavigationStack& stack, const Vec3& point, const Vec3& direction,
                  double limit);
  static State state_of(const kernels::NavigationStack& s) {
    return s.depth < 0 ? State{} : State{s.levels[s.depth].touchable, s.levels[s.depth].volume};
  }

  std::shared_ptr<detail::Shared> shared_;
  std::shared_ptr<Own> own_;  ///< shared with the specialiser, which reads the profile
  const kernels::Context* context_;
  bool shadow_;
};

inline Step Navigator::step(const State& from, const Vec3& point, const Vec3& direction,
                            double limit) {
  // 0 times the sum is 0 unless a number is not finite or the sum overflows; only then is there a
  // closer look. Nothing of the step waits for this test.
  const double sum = 0 * (point.x + point.y + point.z);
  if (!((sum == 0) & (limit >= 0))) [[unlikely]]
    require_numbers(point, limit);
  Own& own = *own_;
  if (own.sphere.holds(from, point, limit) & !shadow_) {
    require_unit(direction);
    ++own.counts.within_safety;
    own.profile.count(own.sphere.state.volume());  // a volume that was checked
    return {limit, false, {own.sphere.state.touchable(), own.sphere.state.volume()}};
  }
  return step_of(own.stack, from, point, direction, limit);
}

inline Step Navigator::step_of(kernels::NavigationStack& stack, const State& from,
                               const Vec3& point, const Vec3& direction, double limit) {
  const double* ray = stack.ray.given;
  if (!(kernels::same_bits(ray[0], direction.x) && kernels::same_bits(ray[1], direction.y) &&
        kernels::same_bits(ray[2], direction.z))) [[unlikely]]
    begin_ray(stack, direction);
  if (!is_at(stack, from)) restore(stack, from);
  return step_on(stack, point, direction, limit);
}

inline Step Navigator::step_on(kernels::NavigationStack& stack, const Vec3& point,
                               const Vec3& direction, double limit) {
  Own& own = *own_;
  const VolumeId volume = stack.levels[stack.depth].volume;
  own.profile.count(volume);
  double length;
  if (own.profile.due()) [[unlikely]] {
    length = recorded_step(stack, point, direction, limit);
  } else {
    own.read_side->enter();
    const kernels::DispatchEntry* entry = kernels::dispatch_entry_of(context_, volume);
    length = entry->step(&stack, context_, entry->data, point.x, point.y, point.z, limit);
    if (length < 0) [[unlikely]]
      length = bail_out(stack, point, direction, limit);
    own.read_side->leave();
  }
  // Written from one place, number by number: if the Step came out of memory, a caller that copies
  // it as a whole would load what was just stored in parts, and wait for each of them.
  return {length, stack.boundary != 0, state_of(stack)};
}

inline double Navigator::safety(const State& from, const Vec3& point, double enough) {
  const double sum = 0 * (point.x + point.y + point.z);
  if (!((sum == 0) & (enough >= 0))) [[unlikely]]
    require_numbers_of_safety(point, enough);
  Own& own = *own_;
  if (!is_at(own.stack, from)) restore(own.stack, from);
  double safety;
  if (own.profile.safety_due()) [[unlikely]] {
    safety = recorded_safety(point, enough);
  } else {
    own.read_side->enter();
    const kernels::DispatchEntry* entry = kernels::dispatch_entry_of(context_, from.volume());
    safety =
        entry->safety(&own.stack, context_, entry->safety_data, point.x, point.y, point.z, enough);
    own.read_side->leave();
  }
  // Number by number, here and in step(): to copy all at once is to load what the caller, or this
  // function, has just stored in parts, and to wait for each of them.
  own.sphere = {{from.touchable(), from.volume()}, {point.x, point.y, point.z}, safety};
  return safety;
}

}  // namespace navjit
