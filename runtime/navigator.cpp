#include "navjit/navigator.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/navigation/generic.hpp"
#include "geometry/navigation/left_for_good.hpp"
#include "geometry/solids/normal.hpp"
#include "runtime/shared.hpp"
#include "runtime/ticks.hpp"

namespace navjit {
namespace {

void require_finite(const Vec3& v, const char* what) {
  if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) {
    throw UsageError(std::string(what) + " is not finite");
  }
}

[[noreturn]] void throw_other_world() { throw UsageError("the state is of another world"); }

/// The levels above the one in which a step begins, which the step may overwrite.
struct Above {
  static constexpr int most = Sample::most_relocations;
  int depth;  ///< where the step begins
  VolumeId volumes[most];
  TouchableId touchables[most];

  explicit Above(const NavigationStack& stack) : depth(stack.depth) {
    for (int i = 0; i < std::min(most, depth); ++i) {
      const StackLevel& level = stack.levels[depth - 1 - i];
      volumes[i] = level.volume;
      touchables[i] = level.touchable;
    }
  }
};

/// Notes, after a step, the volumes in which the track was relocated.
void note_relocations(Sample& sample, const Above& above, const NavigationStack& stack,
                      const kernels::Context* context, const Geometry& geometry) {
  if (stack.boundary == 0) return;
  const auto note = [&](VolumeId volume) {
    if (sample.relocation_count == Sample::most_relocations) return;
    // The table still has the entry that was used, unless it was replaced during this very step,
    // which happens for few samples.
    sample.relocations[sample.relocation_count++] = {volume,
                                                     kernels::dispatch_entry_of(context, volume)};
  };
  int entered = above.depth + 1;  // the level that is new, if there is one
  if (stack.depth < above.depth || stack.levels[above.depth].touchable != sample.touchable) {
    for (int i = 0; i < std::min(Above::most, above.depth); ++i) {
      note(above.volumes[i]);
      entered = above.depth - i;
      if (entered - 1 <= stack.depth &&
          stack.levels[entered - 1].touchable == above.touchables[i]) {
        break;
      }
    }
  }
  for (int i = entered; i <= stack.depth; ++i) {
    const VolumeId volume = stack.levels[i].volume;
    if (!geometry.scene(volume).daughters.empty()) note(volume);
  }
}

}  // namespace

Navigator::Own::Own(std::size_t volumes) : profile(volumes) {
  stack.depth = -1;
  aside.depth = -1;
  stack.boxes_ahead = boxes_ahead;
  // No step has this direction, so that the direction of the first step is checked, too.
  for (double& given : stack.ray.given) given = std::numeric_limits<double>::signaling_NaN();
}

Navigator::Navigator(std::shared_ptr<detail::Shared> shared)
    : shared_(std::move(shared)),
      own_(std::make_shared<Own>(shared_->geometry.size())),
      context_(&shared_->table.context()),
      shadow_(shared_->options.jit == JitMode::shadow) {
  own_->read_side = shared_->table.add_thread();
  shared_->add(std::shared_ptr<Profile>(own_, &own_->profile));
}

Navigator::~Navigator() {
  if (!own_ || !own_->read_side) return;  // moved from
  shared_->table.remove_thread(own_->read_side);
  own_->profile.finish();
}

State Navigator::locate(const Vec3& point) { return locate(point, {0, 0, 0}); }

State Navigator::locate(const Vec3& point, const Vec3& direction) {
  return locate_in(own_->stack, point, direction);
}

State Navigator::locate_in(NavigationStack& stack, const Vec3& point, const Vec3& direction) {
  // The sum is 0 unless a number is not finite or the sum overflows.
  const double sum = 0 * (point.x + point.y + point.z + direction.x + direction.y + direction.z);
  if (!(sum == 0)) [[unlikely]] {
    require_finite(point, "the point");
    require_finite(direction, "the direction");
  }
  if (!locates_along(stack, direction)) {
    generic::locate(shared_->geometry, stack, point, direction);
  } else if (generic::enter(shared_->geometry, stack, point, direction)) {
    relocate_within(stack, point);
  }
  return state_of(stack);
}

bool Navigator::locates_along(NavigationStack& stack, const Vec3& direction) const {
  if (shadow_ || !detail::is_unit_vector(direction.x, direction.y, direction.z)) return false;
  kernels::set_ray(stack, direction.x, direction.y, direction.z);
  return true;
}

void Navigator::relocate_within(NavigationStack& stack, const Vec3& point) {
  if (own_->profile.location_due()) [[unlikely]] {
    recorded_location(stack, point);
    return;
  }
  const VolumeId volume = stack.levels[stack.depth].volume;
  own_->read_side->enter();
  // Adding 0.0 makes negative zeros positive, as generic::locate does.
  kernels::relocate_in_table(&stack, context_, volume, point.x + 0.0, point.y + 0.0, point.z + 0.0,
                             -1);
  own_->read_side->leave();
}

void Navigator::recorded_location(NavigationStack& stack, const Vec3& point) {
  const int outermost = stack.depth;
  const VolumeId volume = stack.levels[outermost].volume;
  own_->read_side->enter();
  const std::uint64_t start = ticks();
  kernels::relocate_in_table(&stack, context_, volume, point.x + 0.0, point.y + 0.0, point.z + 0.0,
                             -1);
  const std::uint64_t taken = ticks() - start;
  const kernels::StackLevel& level = stack.levels[stack.depth];
  Sample sample{level.touchable, level.volume, point, {0, 0, 0}, 0};
  for (int i = outermost; i <= stack.depth; ++i) {
    const VolumeId mother = stack.levels[i].volume;
    if (shared_->geometry.scene(mother).daughters.empty()) continue;
    if (sample.relocation_count == Sample::most_relocations) break;
    sample.relocations[sample.relocation_count++] = {mother,
                                                     kernels::dispatch_entry_of(context_, mother)};
  }
  own_->read_side->leave();
  sample.ticks = taken;
  sample.question = Question::location;
  own_->profile.record(sample);
}

void Navigator::require_numbers_of_safety(const Vec3& point, double enough) {
  require_finite(point, "the point");
  if (!(enough >= 0)) throw UsageError("the safety that is enough is negative, or no number");
}

double Navigator::recorded_safety(const Vec3& point, double enough) {
  const NavigationStack& stack = own_->stack;
  const kernels::StackLevel& level = stack.levels[stack.depth];
  own_->read_side->enter();
  const kernels::DispatchEntry& entry = *kernels::dispatch_entry_of(context_, level.volume);
  Sample sample{level.touchable, level.volume, point, {0, 0, 0}, enough};
  const std::uint64_t start = ticks();
  const double safety =
      entry.safety(&stack, context_, entry.safety_data, point.x, point.y, point.z, enough);
  sample.ticks = ticks() - start;
  own_->read_side->leave();
  sample.used = &entry;
  sample.question = Question::safety;
  own_->profile.record(sample);
  return safety;
}

std::span<Step> Navigator::steps(const State& from, Vec3& point, const Vec3& direction,
                                 double& limit, std::span<Step> buffer) {
  if (buffer.empty()) throw UsageError("the buffer has no room for a step");
  Vec3 at = point;
  double left = limit;
  std::size_t count = 0;
  // Stores a step, and returns whether the ray goes on. Steps are copied number by number: a copy
  // of a step as a whole would load at once what was just stored in parts, and would have to wait
  // for the stores.
  const auto take = [&](const Step& made) {
    buffer[count++] = {made.length, made.boundary, {made.next.touchable(), made.next.volume()}};
    at.x += made.length * direction.x;
    at.y += made.length * direction.y;
    at.z += made.length * direction.z;
    left -= made.length;
    return made.boundary && made.next.inside() && left > 0 && count < buffer.size();
  };
  bool goes_on = take(step(from, point, direction, limit));  // which looks at all arguments
  while (goes_on) goes_on = take(step_on(own_->stack, at, direction, left));
  point = {at.x, at.y, at.z};
  limit = left;
  return buffer.first(count);
}

State Navigator::relocate(const State& hint, const Vec3& point, const Vec3& direction) {
  require_finite(point, "the point");
  require_finite(direction, "the direction");
  if (!hint.inside()) return locate(point, direction);
  NavigationStack& stack = own_->stack;
  restore_unless_at(hint);
  if (!locates_along(stack, direction)) {
    generic::locate_from(shared_->geometry, stack, point, direction);
  } else {
    // The point is not where the ray was.
    stack.left.daughter = kernels::LeftForGood::none;
    stack.left.from = -1;
    if (generic::ascend(shared_->geometry, stack, point, direction)) relocate_within(stack, point);
  }
  return state_of(stack);
}

std::span<const StackLevel> Navigator::levels(const State& state) {
  const NavigationStack& stack = own_->stack;
  // The numbers of touchables ascend from level to level, so the search can end early.
  for (int i = stack.depth; i >= 0 && stack.levels[i].touchable >= state.touchable(); --i) {
    if (stack.levels[i].touchable != state.touchable()) continue;
    if (stack.levels[i].volume != state.volume()) throw_other_world();
    return {stack.levels, static_cast<std::size_t>(i) + 1};
  }
  NavigationStack& aside = own_->aside;
  if (!is_at(aside, state)) bring(aside, state);
  return {aside.levels, static_cast<std::size_t>(aside.depth) + 1};
}

Transformation Navigator::frame(const State& state) { return frame_of(levels(state).back()); }

Transformation Navigator::frame(const State& state, int depth) {
  const std::span<const StackLevel> path = levels(state);
  if (depth < 0 || static_cast<std::size_t>(depth) >= path.size()) {
    throw UsageError("the state has no ancestor at depth " + std::to_string(depth) +
                     ": its own is " + std::to_string(path.size() - 1));
  }
  return frame_of(path[static_cast<std::size_t>(depth)]);
}

Vec3 Navigator::to_local(const State& state, const Vec3& point) {
  return navjit::to_local(frame(state), point);
}

Vec3 Navigator::to_global(const State& state, const Vec3& local_point) {
  return to_outer(frame(state), local_point);
}

Vec3 Navigator::direction_to_local(const State& state, const Vec3& direction) {
  return navjit::direction_to_local(frame(state), direction);
}

Vec3 Navigator::direction_to_global(const State& state, const Vec3& local_direction) {
  return direction_to_outer(frame(state), local_direction);
}

Vec3 Navigator::normal_in(const StackLevel& level, const Vec3& point) const {
  const Transformation at = frame_of(level);
  const Geometry& geometry = shared_->geometry;
  return direction_to_outer(at, navjit::normal(geometry.scene(level.volume).solid,
                                               navjit::to_local(at, point), geometry.tolerance()));
}

Vec3 Navigator::normal(const State& state, const Vec3& point) {
  require_finite(point, "the point");
  return normal_in(levels(state).back(), point);
}

Vec3 Navigator::boundary_normal(const State& from, const State& next, const Vec3& point) {
  require_finite(point, "the point");
  if (from.inside() && next.inside() && from.touchable() < next.touchable()) {
    const std::span<const StackLevel> path = levels(next);
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      if (path[i].touchable != from.touchable()) continue;
      if (path[i].volume != from.volume()) throw_other_world();
      // A daughter was entered, and perhaps deeper ones that are flush with it.
      return -1.0 * normal_in(path[i + 1], point);
    }
  }
  return normal_in(levels(from).back(), point);
}

void Navigator::require_numbers(const Vec3& point, double limit) {
  require_finite(point, "the point");
  if (!(limit >= 0)) throw UsageError("the step limit is negative, or no number");
}

void Navigator::refuse_direction(const Vec3& direction) {
  require_finite(direction, "the direction");
  throw UsageError("the direction is not a unit vector: its length is " +
                   std::to_string(std::hypot(direction.x, direction.y, direction.z)));
}

void Navigator::begin_ray(NavigationStack& stack, const Vec3& direction) {
  require_unit(direction);
  kernels::set_ray(stack, direction.x, direction.y, direction.z);
}

void Navigator::bring(NavigationStack& stack, const State& state) const {
  if (!state.inside()) throw UsageError("the state is outside the world");
  const World& world = shared_->geometry.world();
  if (state.touchable() >= world.volumes[world.top].touchables) throw_other_world();
  generic::restore(shared_->geometry, stack, state.touchable());
  if (!is_at(stack, state)) throw_other_world();
}

void Navigator::restore(NavigationStack& stack, const State& state) {
  ++own_->counts.restored;
  bring(stack, state);
}

double Navigator::recorded_step(NavigationStack& stack, const Vec3& point, const Vec3& direction,
                                double limit) {
  Own& own = *own_;
  const kernels::StackLevel& level = stack.levels[stack.depth];
  const VolumeId volume = level.volume;
  const Above above(stack);
  Sample sample{level.touchable, volume, point, direction, limit};
  if (!shared_->geometry.scene(volume).daughters.empty()) {
    sample.left = stack.levels[stack.depth + 1].daughter;
    sample.left_for_good = find_left_for_good(shared_->geometry, stack, point) == sample.left;
  }
  own.read_side->enter();
  const kernels::DispatchEntry& entry = *kernels::dispatch_entry_of(context_, volume);
  double length;
  if (shadow_) {
    length = shadow(entry, stack, point, direction, limit);
  } else {
    sample.used = &entry;
    const std::uint64_t start = ticks();
    length = entry.step(&stack, context_, entry.data, point.x, point.y, point.z, limit);
    if (length < 0) length = bail_out(stack, point, direction, limit);
    sample.ticks = ticks() - start;
  }
  note_relocations(sample, above, stack, context_, shared_->geometry);
  own.read_side->leave();
  // With shadow mode on all steps are made here, and few of them are recorded.
  if (!shadow_ || own.shadowed++ % Profile::period == 0) own.profile.record(sample);
  if (shadow_) own.profile.come_again();
  return length;
}

double Navigator::bail_out(NavigationStack& stack, const Vec3& point, const Vec3& direction,
                           double limit) {
  ++own_->counts.bail_outs;
  own_->profile.count_bail_out(stack.levels[stack.depth].volume);
  return generic::step(shared_->geometry, stack, point, direction, limit);
}

double Navigator::shadow(const kernels::DispatchEntry& entry, NavigationStack& stack,
                         const Vec3& point, const Vec3& direction, double limit) {
  NavigationStack expected{};
  copy(stack, expected);
  const double right = generic::step(shared_->geometry, expected, point, direction, limit);
  double length = entry.step(&stack, context_, entry.data, point.x, point.y, point.z, limit);
  if (length < 0) length = bail_out(stack, point, direction, limit);
  if (!kernels::same_bits(length, right) || !identical(stack, expected)) {
    ++own_->counts.differences;
    copy(expected, stack);
  }
  return right;
}

}  // namespace navjit
