// Keeps Geant4's history of where a track is equal to navjit's state.
#include <G4LogicalVolume.hh>
#include <G4TouchableHistory.hh>
#include <G4VPVParameterisation.hh>
#include <G4VSolid.hh>
#include <algorithm>

#include "navjit/geant4/navigator.hpp"

namespace navjit::geant4 {
namespace {

/// Sets up what Geant4 has for a track in that copy: its place, dimensions and material.
void set_up_copy(const Placed& placed, const G4NavigationHistory& mother) {
  G4VPhysicalVolume& volume = *placed.volume;
  G4VPVParameterisation* parameterisation = volume.GetParameterisation();
  G4VSolid* solid = parameterisation->ComputeSolid(placed.number, &volume);
  solid->ComputeDimensions(parameterisation, placed.number, &volume);
  parameterisation->ComputeTransformation(placed.number, &volume);
  volume.SetCopyNo(placed.number);
  G4LogicalVolume& logical = *volume.GetLogicalVolume();
  logical.SetSolid(solid);
  const G4TouchableHistory touchable(mother);
  logical.UpdateMaterial(parameterisation->ComputeMaterial(placed.number, &volume, &touchable));
}

}  // namespace

std::span<const kernels::StackLevel> Navigator::path(const State& state) {
  return navigator_->levels(state);
}

void Navigator::enter_level(const Placed& placed, const kernels::StackLevel& level) {
  if (placed.type == kReplica) {
    replicas_.ComputeTransformation(placed.number, placed.volume);
    placed.volume->SetCopyNo(placed.number);
  } else if (placed.type == kParameterised) {
    set_up_copy(placed, fHistory);
  }
  fHistory.NewLevel(placed.volume, placed.type, placed.number);
  levels_.push_back({level.touchable, level.volume});
}

std::size_t Navigator::follow(const State& next) {
  state_ = next;
  std::size_t kept = levels_.size() - 1;
  if (!next.inside()) {
    fHistory.BackLevel(static_cast<G4int>(kept));
    levels_.resize(1);
    return 0;
  }
  const auto path = this->path(next);
  kept = std::min(kept, path.size() - 1);
  while (kept > 0 && path[kept].touchable != levels_[kept].touchable) --kept;
  if (kept + 1 < levels_.size()) {
    fHistory.BackLevel(static_cast<G4int>(levels_.size() - 1 - kept));
    levels_.resize(kept + 1);
  }
  for (std::size_t at = kept + 1; at < path.size(); ++at) {
    enter_level(engine_->geometry.placed(levels_.back().volume, path[at].daughter), path[at]);
  }
  return kept;
}

std::optional<State> Navigator::adopt(const G4NavigationHistory& history) {
  const std::size_t depth = history.GetDepth();
  // Levels that are the same object are the same place, and so are the levels above them.
  const std::size_t most = std::min(depth, levels_.size() - 1);
  std::size_t kept = most;
  const auto one_object = [&](std::size_t at) {
    const auto level = static_cast<G4int>(at);
    return &history.GetTransform(level) == &fHistory.GetTransform(level);
  };
  const auto same_copy = [&](std::size_t at) {
    const auto level = static_cast<G4int>(at);
    return history.GetVolume(level) == fHistory.GetVolume(level) &&
           history.GetReplicaNo(level) == fHistory.GetReplicaNo(level);
  };
  while (kept > 0 && !one_object(kept)) --kept;
  while (kept < most && same_copy(kept + 1)) ++kept;
  if (kept == depth) {
    fHistory.BackLevel(static_cast<G4int>(levels_.size() - 1 - kept));
    levels_.resize(kept + 1);
    return State{levels_.back().touchable, levels_.back().volume};
  }
  levels_.resize(kept + 1);
  for (std::size_t at = kept + 1; at <= depth; ++at) {
    const auto level = static_cast<G4int>(at);
    const Level mother = levels_.back();
    const Placed* placed = engine_->geometry.find(mother.volume, *history.GetVolume(level),
                                                  history.GetReplicaNo(level));
    if (placed == nullptr) {
      fHistory.Reset();
      levels_.resize(1);
      return std::nullopt;
    }
    levels_.push_back({mother.touchable + placed->offset, placed->id});
  }
  fHistory = history;
  return State{levels_.back().touchable, levels_.back().volume};
}

G4VPhysicalVolume* Navigator::reset(const G4ThreeVector& point, const G4ThreeVector& direction,
                                    const G4TouchableHistory& history) {
  attach();
  if (!engine_) return G4Navigator::ResetHierarchyAndLocate(point, direction, history);
  ResetState();
  forget_steps();
  zero_steps_ = 0;
  const std::optional<State> start = adopt(*history.GetHistory());
  if (!start) return Navigator::locate(point, &direction, false, false);
  state_ = *start;
  if (!engine_->geometry.plain()) SetupHierarchy();
  // If there is room about the point, it is in no other volume. The safety that shows this is what
  // multiple scattering asks for next; often it was asked where the parent was.
  const Vec3 at{point.x(), point.y(), point.z()};
  double safety = safeties_.find(state_, at);
  if (safety < 0) safety = new_distance_to_boundary(at);
  if (safety > 0) return fHistory.GetTopVolume();
  G4VPhysicalVolume* const found = Navigator::locate(point, &direction, true, false);
  // A track that is resumed on the face between two copies of one volume stays in its copy, as with
  // Geant4's own navigator: the stepping manager compares volumes alone, and would not notice.
  if (state_ != *start && found == history.GetVolume() &&
      navigator_->relocate(*start, at, Vec3{0, 0, 0}) == *start) {
    follow(*start);
    return fHistory.GetTopVolume();
  }
  return found;
}

}  // namespace navjit::geant4
