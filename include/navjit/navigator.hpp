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

/// Counts of one navigator, beside the profile.
struct NavigatorCounts {
  std::uint64_t bail_outs = 0;      ///< states that a specialised navigator did not take
  std::uint64_t differences = 0;    ///< shadow mode: answers that were not the generic one's
  std::uint64_t restored = 0;       ///< states that were not the last one returned
  std::uint64_t within_safety = 0;  ///< steps that stayed in the ball of the last safety
};

/// Answers where, how far and what next. One per thread; keeps the runtime's data alive. Points and
/// directions are global and have to be finite, directions of steps of unit length (to 1e-5).
/// States are good in any navigator of their world. What breaks these rules is answered by
/// UsageError, and the navigator stays as good as it was; one that was moved from may
/// only be destroyed.
class Navigator {
 public:
  Navigator(Navigator&&) noexcept = default;
  Navigator& operator=(Navigator&&) = delete;
  ~Navigator();

  /// The deepest touchable with the point, or outside. On a face that volumes share, the first of
  /// them in file order; where volumes overlap, the last. Throws UsageError if a
  /// coordinate is not finite.
  State locate(const Vec3& point);
  /// As above; on a face the direction decides.
  State locate(const Vec3& point, const Vec3& direction);

  /// One step from `point` in `state`, at most `limit` mm; a limit of 0 or infinity is one.
  /// Throws UsageError if the state is outside the world or of another world, if the
  /// point is not finite, if the direction is not a unit vector, or if the limit is negative or not
  /// a number. (A state of another world is not recognised where it has the same touchable and
  /// volume numbers as one of this world; then it is taken for that.)
  ///
  /// A step that stays in the ball of the last safety() that was asked, in the same state, is the
  /// limit, and nothing of the detector is looked at: most steps of particles that scatter.
  Step step(const State& state, const Vec3& point, const Vec3& direction,
            double limit = std::numeric_limits<double>::infinity());

  /// All steps of a straight ray in one call, for rays that only look (pictures, scans of
  /// materials): from boundary to boundary until the ray leaves the world, until `limit` mm are
  /// gone in all, or until the buffer is full. Returns those that were made, at the front of the
  /// buffer; there is at least one. Each is the step() from where the one before ended, bit for
  /// bit, with `point = point + length * direction`, number by number, and `limit = limit -
  /// length`. The point and the limit are moved on to where the last one ended, so that the same
  /// call with its `next` goes on. Throws as step(), and UsageError if the buffer is empty; then
  /// nothing was moved.
  std::span<Step> steps(const State& state, Vec3& point, const Vec3& direction, double& limit,
                        std::span<Step> buffer);

  /// A lower bound of the distance to the nearest boundary, mm; `enough` if that is less. Throws
  /// UsageError if the state is outside the world or of another world, if a coordinate is not
  /// finite, or if `enough` is negative or not a number. The answer depends on the arguments alone,
  /// and is kept for the steps that follow.
  ///
  /// What is farther away than `enough` need not be looked at, which makes small ones cheap: a
  /// caller that wants to know whether a step of some length stays in the volume asks for that
  /// length.
  double safety(const State& state, const Vec3& point,
                double enough = std::numeric_limits<double>::infinity());

  /// As step(), where the caller has a safety sphere: a step that stays in it is the limit, and
  /// nothing of the detector is looked at. Else the answer is that of step(). Throws as step().
  Step step(const State& state, const Vec3& point, const Vec3& direction, double limit,
            const SafetySphere& sphere) {
    if (sphere.holds(state, point, limit)) return {limit, false, state};
    return step(state, point, direction, limit);
  }

  /// The ball about the point that safety() promises: steps in it need no geometry, and a point
  /// that is displaced in it stays in the state. Throws as safety().
  SafetySphere safety_sphere(const State& state, const Vec3& point,
                             double enough = std::numeric_limits<double>::infinity()) {
    return {state, point, safety(state, point, enough)};
  }

  /// The deepest touchable with a point that is in the hint, or near it: after a displacement in a
  /// volume that costs a look at the volume and its daughters. (A displacement within the safety
  /// needs no call: states hold no point.) As locate(), but where several touchables hold the
  /// point, on faces and in overlaps, it is one of those that are nearest to the hint in the tree.
  /// The hint may be outside the world. Throws UsageError if a number is not finite or the hint is
  /// of another world.
  State relocate(const State& hint, const Vec3& point, const Vec3& direction);

  /// From the world into the state's frame, or into that of its ancestor at a depth (0: the world
  /// volume): the bits that navigation uses. Throws UsageError if there is none.
  Transformation frame(const State& state);
  Transformation frame(const State& state, int depth);
  /// Points (mm) and directions in the state's frame and back. Throw UsageError if the state is
  /// outside the world or of another world.
  Vec3 to_local(const State& state, const Vec3& point);
  Vec3 to_global(const State& state, const Vec3& local_point);
  Vec3 direction_to_local(const State& state, const Vec3& direction);
  Vec3 direction_to_global(const State& state, const Vec3& local_direction);

  /// The outward unit normal of the state's volume, in the world's frame, at a point (mm) on its
  /// surface, or near it: then that of the nearest face. On edges it is that of the first of their
  /// faces (docs/normals.md). Throws UsageError if the point is not finite, or if the state is
  /// outside the world or of another world.
  Vec3 normal(const State& state, const Vec3& point);
  /// The unit normal of the boundary that a step from `from` ended on, at its end `point`; it
  /// points out of what was left: out of the volume of `from`, or into the daughter of it that was
  /// entered. `next` is Step::next. Throws as normal().
  Vec3 boundary_normal(const State& from, const State& next, const Vec3& point);

  /// For programs with paths of their own: the levels from the world volume down to the state that
  /// locate(), relocate(), or a step() that changed the state gave last; each with its touchable,
  /// its volume, and its number among the mother's daughters. Those whose touchables are as before
  /// need not be written anew. Empty outside the world. Good until the next call.
  std::span<const kernels::StackLevel> levels() const {
    return {own_->stack.levels, static_cast<std::size_t>(own_->stack.depth + 1)};
  }

  /// The same of any state. The track stays where it is. Throws UsageError if the state is outside
  /// the world or of another world.
  std::span<const kernels::StackLevel> levels(const State& state);

  /// What this navigator did so far.
  const NavigatorCounts& counts() const { return own_->counts; }

 private:
  friend class Runtime;
  friend class Basket;
  struct Own {
    kernels::NavigationStack stack{};
    /// Where questions about another state are answered, so that the track stays where it is.
    kernels::NavigationStack aside{};
    kernels::BoxesAhead boxes_ahead[2]{};  ///< of the stack
    Profile profile;
    std::shared_ptr<ReadSide> read_side;
    NavigatorCounts counts;
    SafetySphere sphere{};       ///< of the last safety that was asked
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
  /// Steps of the stack will be along another direction. Throws as require_unit().
  static void begin_ray(kernels::NavigationStack& stack, const Vec3& direction);
  /// Whether specialised navigators may locate a point that has this direction: they answer for
  /// directions of unit length, which becomes the stack's ray.
  bool locates_along(kernels::NavigationStack& stack, const Vec3& direction) const;
  /// The point is in the innermost level: into its daughters.
  void relocate_within(kernels::NavigationStack& stack, const Vec3& point);
  /// The same, recorded for the specialiser.
  void recorded_location(kernels::NavigationStack& stack, const Vec3& point);
  /// Brings the stack to the state. Throws UsageError if the world has no such state.
  void bring(kernels::NavigationStack& stack, const State& state) const;
  /// The same, counted.
  void restore(kernels::NavigationStack& stack, const State& state);
  /// Of the level's volume, in the world's frame.
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
  /// A step of a track whose stack this is; its arguments are good.
  Step step_of(kernels::NavigationStack& stack, const State& from, const Vec3& point,
               const Vec3& direction, double limit);
  /// As step_of(), where the stack is along the direction and at the state already.
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
  // 0 times the sum is 0 unless a number is not finite, or the sum is beyond all numbers; then
  // there is time for a closer look. Nothing of the step waits for it.
  const double sum = 0 * (point.x + point.y + point.z);
  if (!((sum == 0) & (limit >= 0))) [[unlikely]]
    require_numbers(point, limit);
  Own& own = *own_;
  if (own.sphere.holds(from, point, limit) & !shadow_) {
    require_unit(direction);
    ++own.counts.within_safety;
    own.profile.count(own.sphere.state.volume());  // one that was checked
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
  // From one place, number by number: where a Step came out of memory, a caller that copies it as a
  // whole would load what was just stored in parts, and wait for each of them.
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
  // Number by number, here and in step(): a copy of all at once loads what the caller, or this, has
  // just stored in parts, and has to wait for each of them.
  own.sphere = {{from.touchable(), from.volume()}, {point.x, point.y, point.z}, safety};
  return safety;
}

}  // namespace navjit
