// A navigator for Geant4 which asks navjit.
#pragma once

#include <G4Navigator.hh>
#include <G4ReplicaNavigation.hh>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "navjit/geant4/known_safeties.hpp"
#include "navjit/geant4/session.hpp"

namespace navjit::geant4 {

/// Geant4's navigator of one thread, with navjit's answers. Geant4's own code finds what it
/// expects: the history of where the track is after each call that locates, flags of what was
/// entered and left, infinity where physics limits a step. A world that navjit refuses is navigated
/// by the base class. The base class alone answers SeverityOfZeroStepping (0),
/// GetCurrentLocalCoordinate, and what SetVerboseLevel and CheckMode print.
class Navigator : public G4Navigator {
 public:
  explicit Navigator(std::shared_ptr<Session> session);
  ~Navigator() override;

  G4double ComputeStep(const G4ThreeVector& point, const G4ThreeVector& direction, G4double limit,
                       G4double& safety) override;
  G4VPhysicalVolume* ResetHierarchyAndLocate(const G4ThreeVector& point,
                                             const G4ThreeVector& direction,
                                             const G4TouchableHistory& history) override;
  G4VPhysicalVolume* LocateGlobalPointAndSetup(const G4ThreeVector& point,
                                               const G4ThreeVector* direction = nullptr,
                                               G4bool relative = true,
                                               G4bool ignore_direction = true) override;
  void LocateGlobalPointWithinVolume(const G4ThreeVector& point) override;
  G4double ComputeSafety(const G4ThreeVector& point, G4double enough = DBL_MAX,
                         G4bool keep_state = true) override;
  G4ThreeVector GetLocalExitNormal(G4bool* valid) override;
  G4ThreeVector GetLocalExitNormalAndCheck(const G4ThreeVector& point, G4bool* valid) override;
  G4ThreeVector GetGlobalExitNormal(const G4ThreeVector& point, G4bool* valid) override;

  /// navjit's state of the track; outside the world also while Geant4 navigates.
  const State& state() const { return state_; }
  /// The depth of the innermost level of Geant4's history; 0 is the world.
  std::size_t depth() const { return levels_.size() - 1; }
  /// Whether navjit answers: it does from the first call on that locates a point in a world.
  bool active() const { return engine_ != nullptr; }
  const Session& session() const { return *session_; }

 protected:
  /// Also called by ResetStackAndState(), which is public and resets Geant4's history beforehand.
  void ResetState() override;

  /// A boundary that a step found.
  struct Crossing {
    bool found = false;
    bool entering = false, exiting = false;
    State from{}, next{};
    std::size_t depth = 0;  ///< the depth of `from`
    Vec3 start{}, direction{}, end{};
    double limit = 0;
  };

  // What Geant4's calls do, without counting them.
  virtual G4double step(const G4ThreeVector& point, const G4ThreeVector& direction, G4double limit,
                        G4double& safety);
  virtual G4VPhysicalVolume* reset(const G4ThreeVector& point, const G4ThreeVector& direction,
                                   const G4TouchableHistory& history);
  virtual G4VPhysicalVolume* locate(const G4ThreeVector& point, const G4ThreeVector* direction,
                                    bool relative, bool ignore_direction);
  virtual void relocate_within(const G4ThreeVector& point);
  virtual G4double safety_at(const G4ThreeVector& point, G4double enough);
  /// The normal, in the world's frame, of the boundary that Geant4 is at. Null if there is none.
  virtual G4ThreeVector exit_normal(const Crossing& crossing);

  /// The boundary that the track is at: that of the last step, or the one to which the last locate
  /// brought it. Null if there is none.
  const Crossing* boundary() const;
  /// That of the last two steps which the track has made: the other may be a CheckNextStep.
  const Crossing* made_step(const Vec3& point) const;
  /// At most the distance, mm, from the point to the nearest boundary around the track.
  double distance_to_boundary(const Vec3& point);
  /// The same where no safety is known for the point.
  double new_distance_to_boundary(const Vec3& point);
  Counts& counts() { return *counts_; }

 private:
  struct Level {
    TouchableId touchable;
    VolumeId volume;
  };

  /// Asks the session for the world, unless it was asked for the same one last.
  void attach();
  /// The path to a state; valid until navjit is asked again.
  std::span<const kernels::StackLevel> path(const State& state);
  /// Makes the history that of the state; returns the depth down to which it did not change.
  std::size_t follow(const State& next);
  /// Takes over the state of a history of Geant4's; nothing if the history has a volume that is not
  /// in the world.
  std::optional<State> adopt(const G4NavigationHistory& history);
  void enter_level(const Placed& placed, const kernels::StackLevel& level);
  /// Fetches into the cache what the history needs of a state: else the next locate waits for it.
  void fetch_placement(const State& next);
  /// Whether the state is the touchable at that depth, or is within it.
  bool is_within(const State& state, std::size_t depth, TouchableId ancestor);
  /// The state as found; but a track that starts on the world's own face is in the world.
  State on_world(const State& found, const G4ThreeVector& point) const;
  State behind(const Crossing& crossing, const Vec3& point, const Vec3& direction);
  /// Counts steps that do not move. Returns the length of this one, which may be pushed.
  double checked_length(const Step& step, const Vec3& point, const Vec3& direction, State& next);
  void forget_steps();

  std::shared_ptr<Session> session_;
  std::shared_ptr<Counts> counts_;
  std::shared_ptr<Engine> engine_{};
  std::optional<navjit::Navigator> navigator_{};
  const G4VPhysicalVolume* asked_world_ = nullptr;
  std::uint64_t asked_generation_ = 0;
  G4ReplicaNavigation replicas_{};
  State state_{};
  std::vector<Level> levels_{};  ///< those of the history
  Crossing steps_[2]{};
  int last_step_ = 0;
  const Crossing* crossed_ = nullptr;  ///< the boundary crossed by the last locate
  bool stepped_ = false;               ///< whether there was a step since the last locate
  bool in_reset_ = false;
  KnownSafeties safeties_{};
  unsigned steps_within_ = 0;  ///< number of steps that ended within the safety
  int zero_steps_ = 0;
};

}  // namespace navjit::geant4
