#include "navjit/geant4/navigator.hpp"

#include <G4LogicalVolume.hh>
#include <G4TouchableHistory.hh>
#include <G4VSolid.hh>
#include <algorithm>
#include <limits>
#include <sstream>
#include <string>

#include "adapters/geant4/guarded.hpp"
#include "adapters/geant4/vector.hpp"

namespace navjit::geant4 {
namespace {

/// Counts a call, and times one of many of them.
class Counted {
 public:
  Counted(Counts& counts, Call call) : count_(counts.calls[static_cast<std::size_t>(call)]) {
    // The first is not timed, since it may convert the world.
    timed_ = (++count_.calls & (sampled_calls - 1)) == 0;
    if (timed_) [[unlikely]]
      start_ = sampling_time();
  }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;
  ~Counted() {
    if (!timed_) [[likely]]
      return;
    count_.sampled_seconds += sampling_time() - start_;
    ++count_.sampled;
  }

 private:
  CallCount& count_;
  double start_;
  bool timed_;
};

constexpr int push_after = 10;     ///< steps that do not move
constexpr int abandon_after = 25;  ///< the same

}  // namespace

Navigator::Navigator(std::shared_ptr<Session> session)
    : session_(std::move(session)), counts_(session_->new_counts()) {}

Navigator::~Navigator() = default;

void Navigator::attach() {
  if (GetWorldVolume() == asked_world_ && session_->generation() == asked_generation_) return;
  asked_generation_ = session_->generation();
  asked_world_ = GetWorldVolume();
  navigator_.reset();
  engine_ = asked_world_ == nullptr ? nullptr : session_->engine(*GetWorldVolume());
  forget_steps();
  safeties_.clear();
  state_ = {};
  levels_.clear();
  if (!engine_) return;
  navigator_.emplace(engine_->runtime.navigator());
  fHistory.Reset();
  levels_.push_back({0, engine_->geometry.detector().world_volume()});
}

void Navigator::ResetState() {
  G4Navigator::ResetState();
  const auto depth = static_cast<std::size_t>(fHistory.GetDepth());
  if (!engine_ || levels_.size() == depth + 1) return;
  // Whoever reset the history left the track in the world.
  levels_.resize(1);
  state_ = {levels_[0].touchable, levels_[0].volume};
  forget_steps();
}

void Navigator::forget_steps() {
  steps_[0].found = steps_[1].found = false;
  crossed_ = nullptr;
  stepped_ = false;
}

G4double Navigator::step(const G4ThreeVector& point, const G4ThreeVector& direction, G4double limit,
                         G4double& safety) {
  // From outside the world Geant4's own navigator finds the way in, as it does without navjit.
  if (!engine_ || !state_.inside()) {
    return G4Navigator::ComputeStep(point, direction, limit, safety);
  }
  const Vec3 from = vector(point), along = vector(direction);
  Crossing& crossing = steps_[last_step_ ^= 1];
  crossing.found = false;
  stepped_ = true;
  fEnteredDaughter = fExitedMother = false;
  // Multiple scattering has asked for the safety where it needs it; on boundaries the safety is 0,
  // and neutral particles do not use it.
  safety = std::max(safeties_.last(state_, from), 0.0);
  // Now and then navjit is asked nevertheless, so that it learns what is hot.
  constexpr unsigned asked_steps = 16;  // one in so many
  if (limit <= safety && ++steps_within_ % asked_steps != 0) {
    zero_steps_ = 0;
    fStepEndPoint = point + limit * direction;
    return kInfinity;
  }
  const Step step = navigator_->step(state_, from, along, limit);
  if (!step.boundary) {
    zero_steps_ = 0;
    fStepEndPoint = point + limit * direction;
    return kInfinity;
  }
  crossing.next = step.next;
  const double length = checked_length(step, from, along, crossing.next);
  fetch_placement(crossing.next);
  crossing.found = true;
  crossing.entering = is_within(crossing.next, levels_.size() - 1, state_.touchable()) &&
                      !(crossing.next == state_);
  crossing.exiting = !crossing.entering;
  crossing.from = state_;
  crossing.depth = levels_.size() - 1;
  crossing.start = from;
  crossing.direction = along;
  crossing.limit = limit;
  crossing.end = from + length * along;
  fEnteredDaughter = crossing.entering;
  fExitedMother = crossing.exiting;
  fStepEndPoint = vector(crossing.end);
  return length;
}

double Navigator::checked_length(const Step& step, const Vec3& point, const Vec3& direction,
                                 State& next) {
  if (step.length >= fMinStep) [[likely]] {
    zero_steps_ = 0;
    return step.length;
  }
  ++zero_steps_;
  ++counts_->zero_steps;
  if (zero_steps_ < push_after) return step.length;
  const double length = step.length + 100 * kCarTolerance;
  next = navigator_->relocate(next, point + length * direction, direction);
  if (zero_steps_ == push_after) ++counts_->pushed;
  if (zero_steps_ >= abandon_after) {
    ++counts_->abandoned;
    std::ostringstream message;
    message.precision(17);
    message << "a track did not move for " << zero_steps_ << " steps, at " << vector(point)
            << " along " << vector(direction) << ", in "
            << engine_->geometry.detector().path_of(state_) << "; the event is aborted";
    G4Exception("navjit::geant4::Navigator::ComputeStep()", "navjit0002", EventMustBeAborted,
                message.str().c_str());
  }
  return length;
}

G4VPhysicalVolume* Navigator::locate(const G4ThreeVector& point, const G4ThreeVector* direction,
                                     bool relative, bool ignore_direction) {
  attach();
  if (!engine_) {
    return G4Navigator::LocateGlobalPointAndSetup(point, direction, relative, ignore_direction);
  }
  const Vec3 at = vector(point);
  const Vec3 along = direction != nullptr && !ignore_direction ? vector(*direction) : Vec3{0, 0, 0};
  if (!relative) {
    ResetStackAndState();
    levels_.resize(1);
    forget_steps();
    zero_steps_ = 0;
    fEnteredDaughter = follow(on_world(navigator_->locate(at, along), point)) < levels_.size() - 1;
    return state_.inside() ? fHistory.GetTopVolume() : nullptr;
  }
  const Crossing* made = fWasLimitedByGeometry ? made_step(at) : nullptr;
  fWasLimitedByGeometry = false;
  fExitedMother = made != nullptr && made->exiting;
  const State next = made != nullptr
                         ? behind(*made, at, direction != nullptr ? vector(*direction) : along)
                         : on_world(navigator_->relocate(state_, at, along), point);
  const std::size_t kept = follow(next);
  fEnteredDaughter = kept < levels_.size() - 1;
  crossed_ = made;
  stepped_ = false;
  return state_.inside() ? fHistory.GetTopVolume() : nullptr;
}

State Navigator::on_world(const State& found, const G4ThreeVector& point) const {
  if (found.inside()) return found;
  const G4VSolid& world = *GetWorldVolume()->GetLogicalVolume()->GetSolid();
  if (world.Inside(point) == kOutside) return found;
  return {0, engine_->geometry.detector().world_volume()};
}

const Navigator::Crossing* Navigator::made_step(const Vec3& point) const {
  const auto distance = [&](const Crossing& crossing) { return norm(crossing.end - point); };
  const Crossing &last = steps_[last_step_], &before = steps_[last_step_ ^ 1];
  // With a field the boundary is where a chord of the track meets it, which is near the point.
  const bool take_last =
      last.found && last.from == state_ &&
      !(before.found && before.from == state_ && distance(before) < distance(last));
  if (take_last) return &last;
  return before.found && before.from == state_ ? &before : nullptr;
}

State Navigator::behind(const Crossing& crossing, const Vec3& point, const Vec3& direction) {
  constexpr double same_point = 1e-6;  // mm
  const Vec3 beside = point - crossing.end;
  if (dot(beside, beside) <= same_point * same_point || !crossing.next.inside()) {
    return crossing.next;
  }
  // In a field the track ends beside the chord's crossing: what it left and entered is known, and
  // what else is there is looked up.
  const State found = navigator_->relocate(crossing.next, point, direction);
  const std::size_t depth = levels_.size() - 1;
  if (crossing.entering) {
    const kernels::StackLevel& level = path(crossing.next)[depth + 1];
    const State entered{level.touchable, level.volume};
    return is_within(found, depth + 1, entered.touchable()) ? found : entered;
  }
  return is_within(found, depth, crossing.from.touchable()) ? crossing.next : found;
}

void Navigator::fetch_placement(const State& next) {
  if (!next.inside()) return;
  const auto levels = path(next);
  if (levels.size() < 2) return;
  const VolumeId mother = levels[levels.size() - 2].volume;
  __builtin_prefetch(&engine_->geometry.placed(mother, levels.back().daughter));
}

bool Navigator::is_within(const State& state, std::size_t depth, TouchableId ancestor) {
  if (!state.inside()) return false;
  const auto levels = path(state);
  return levels.size() > depth && levels[depth].touchable == ancestor;
}

void Navigator::relocate_within(const G4ThreeVector& point) {
  if (!engine_ || !state_.inside()) return G4Navigator::LocateGlobalPointWithinVolume(point);
  forget_steps();
  fEnteredDaughter = fExitedMother = false;
}

G4double Navigator::safety_at(const G4ThreeVector& point, G4double enough) {
  if (!engine_ || !state_.inside()) return G4Navigator::ComputeSafety(point, enough);
  if ((fEnteredDaughter || fExitedMother) &&
      (point - fStepEndPoint).mag2() < kCarTolerance * kCarTolerance) {
    return 0;
  }
  // The whole safety, as Geant4's own: multiple scattering asks with the length of a step, but
  // makes its steps longer if there is room.
  return distance_to_boundary(vector(point));
}

double Navigator::distance_to_boundary(const Vec3& point) {
  if (const double known = safeties_.last(state_, point); known >= 0) return known;
  return new_distance_to_boundary(point);
}

double Navigator::new_distance_to_boundary(const Vec3& point) {
  const double safety = navigator_->safety(state_, point);
  safeties_.add(state_, point, safety);
  return safety;
}

const Navigator::Crossing* Navigator::boundary() const {
  if (!stepped_) return crossed_;
  return steps_[last_step_].found ? &steps_[last_step_] : nullptr;
}

G4ThreeVector Navigator::exit_normal(const Crossing& crossing) {
  if (!crossing.entering) return vector(navigator_->normal(crossing.from, crossing.end));
  const kernels::StackLevel& level = path(crossing.next)[crossing.depth + 1];
  return -vector(navigator_->normal({level.touchable, level.volume}, crossing.end));
}

// The functions that Geant4 calls.

G4double Navigator::ComputeStep(const G4ThreeVector& point, const G4ThreeVector& direction,
                                const G4double limit, G4double& safety) {
  const Counted counted(*counts_, Call::step);
  return guarded(
      "navjit::geant4::Navigator::ComputeStep()",
      [&] { return step(point, direction, limit, safety); }, G4double{kInfinity});
}

G4VPhysicalVolume* Navigator::ResetHierarchyAndLocate(const G4ThreeVector& point,
                                                      const G4ThreeVector& direction,
                                                      const G4TouchableHistory& history) {
  const Counted counted(*counts_, Call::reset);
  in_reset_ = true;  // Geant4's ResetHierarchy locates by the public call
  auto* volume = guarded(
      "navjit::geant4::Navigator::ResetHierarchyAndLocate()",
      [&] { return reset(point, direction, history); }, static_cast<G4VPhysicalVolume*>(nullptr));
  in_reset_ = false;
  return volume;
}

G4VPhysicalVolume* Navigator::LocateGlobalPointAndSetup(const G4ThreeVector& point,
                                                        const G4ThreeVector* direction,
                                                        const G4bool relative,
                                                        const G4bool ignore_direction) {
  if (in_reset_) return locate(point, direction, relative, ignore_direction);
  const Counted counted(*counts_, Call::locate);
  return guarded(
      "navjit::geant4::Navigator::LocateGlobalPointAndSetup()",
      [&] { return locate(point, direction, relative, ignore_direction); },
      static_cast<G4VPhysicalVolume*>(nullptr));
}

void Navigator::LocateGlobalPointWithinVolume(const G4ThreeVector& point) {
  const Counted counted(*counts_, Call::relocate_within);
  relocate_within(point);
}

G4double Navigator::ComputeSafety(const G4ThreeVector& point, const G4double enough,
                                  const G4bool /*keep_state*/) {
  const Counted counted(*counts_, Call::safety);
  return guarded(
      "navjit::geant4::Navigator::ComputeSafety()", [&] { return safety_at(point, enough); }, 0.0);
}

G4ThreeVector Navigator::GetGlobalExitNormal(const G4ThreeVector& point, G4bool* valid) {
  const Counted counted(*counts_, Call::normal);
  if (!engine_) return G4Navigator::GetGlobalExitNormal(point, valid);
  const Crossing* crossing = boundary();
  *valid = crossing != nullptr;
  return *valid ? exit_normal(*crossing) : G4ThreeVector();
}

G4ThreeVector Navigator::GetLocalExitNormal(G4bool* valid) {
  const Counted counted(*counts_, Call::normal);
  if (!engine_) return G4Navigator::GetLocalExitNormal(valid);
  const Crossing* crossing = boundary();
  *valid = crossing != nullptr;
  if (!*valid) return {};
  // In the frame of the volume that the track comes to: before the locate this is the mother, if
  // the track leaves.
  const auto depth = static_cast<G4int>(fHistory.GetDepth());
  const bool leaving = stepped_ && crossing->exiting && depth > 0;
  return fHistory.GetTransform(leaving ? depth - 1 : depth).TransformAxis(exit_normal(*crossing));
}

G4ThreeVector Navigator::GetLocalExitNormalAndCheck(const G4ThreeVector& /*point*/, G4bool* valid) {
  return GetLocalExitNormal(valid);
}

}  // namespace navjit::geant4
