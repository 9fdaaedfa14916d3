#include "navjit/geant4/transportation.hpp"

#include <G4Navigator.hh>
#include <G4ParticleTable.hh>
#include <G4ProcessManager.hh>
#include <G4PropagatorInField.hh>
#include <G4StateManager.hh>
#include <G4Track.hh>
#include <G4VExceptionHandler.hh>
#include <string_view>
#include <typeinfo>

#include "navjit/geant4/navigator.hpp"

namespace navjit::geant4 {
namespace {

/// Number of places with a kept touchable, a power of two: a shower is in few at a time.
constexpr std::size_t places = 256;

/// The particle's process, unless it is of another class; null if there is none.
G4Transportation* plain_transportation(const G4ProcessManager& manager) {
  const G4ProcessVector& list = *manager.GetProcessList();
  for (G4int i = 0; i < static_cast<G4int>(list.entries()); ++i) {
    if (list[i] != nullptr && typeid(*list[i]) == typeid(G4Transportation)) {
      return static_cast<G4Transportation*>(list[i]);
    }
  }
  return nullptr;
}

/// Geant4 warns if a process becomes the first and another one was so before, even if that has been
/// removed. While this object lives, that warning is dropped; all others go to the handler before.
class WithoutWarningsOfTwoFirsts : public G4VExceptionHandler {
 public:
  /// `before` is the present handler. The base class makes this object the handler.
  explicit WithoutWarningsOfTwoFirsts(G4VExceptionHandler* before) : before_(before) {}
  ~WithoutWarningsOfTwoFirsts() override {
    G4StateManager::GetStateManager()->SetExceptionHandler(before_);
  }
  G4bool Notify(const char* origin, const char* code, G4ExceptionSeverity severity,
                const char* text) override {
    if (std::string_view(code) == "ProcMan113") return false;
    return before_ == nullptr ? severity != JustWarning
                              : before_->Notify(origin, code, severity, text);
  }

 private:
  G4VExceptionHandler* const before_;
};

}  // namespace

Transportation::Transportation(G4int verbosity)
    : G4Transportation(verbosity, "Transportation"), table_(places) {}

Navigator* Transportation::navjit() {
  if (known_ != fLinearNavigator) {
    known_ = fLinearNavigator;
    ours_ = dynamic_cast<Navigator*>(fLinearNavigator);
  }
  return ours_ != nullptr && ours_->active() ? ours_ : nullptr;
}

const G4TouchableHandle& Transportation::touchable_of(Navigator& navigator) {
  if (const std::uint64_t generation = navigator.session().generation();
      generation != generation_) {
    table_ = std::vector<Kept>(places);  // an empty handle cannot be copied into one that is not
    generation_ = generation;
  }
  const State& state = navigator.state();
  Kept& kept = table_[state.touchable() % places];
  const auto depth = static_cast<G4int>(navigator.depth());
  if (kept.touchable && kept.at == state.touchable() &&
      kept.touchable->GetHistoryDepth() == depth) {
    ++kept_;
  } else {
    ++made_;
    kept.at = state.touchable();
    kept.touchable = navigator.CreateTouchableHistory();
  }
  return kept.touchable;
}

G4VParticleChange* Transportation::PostStepDoIt(const G4Track& track, const G4Step& step) {
  Navigator* const navigator = fGeometryLimitedStep ? navjit() : nullptr;
  if (navigator == nullptr) return G4Transportation::PostStepDoIt(track, step);

  fParticleChange.ProposeTrackStatus(track.GetTrackStatus());
  navigator->SetGeometricallyLimitedStep();
  const G4ThreeVector direction = track.GetMomentumDirection();
  navigator->LocateGlobalPointAndSetup(track.GetPosition(), &direction);
  const bool crossed = navigator->EnteredDaughterVolume() || navigator->ExitedMotherVolume();
  if (!navigator->state().inside()) {
    if (crossed) fCurrentTouchableHandle = new G4TouchableHistory;  // of no volume
    fParticleChange.ProposeTrackStatus(fStopAndKill);
  } else if (crossed) {
    fCurrentTouchableHandle = touchable_of(*navigator);
  }
  fParticleChange.SetTouchableHandle(fCurrentTouchableHandle);
  fLastStepInVolume = fFieldExertedForce ? fFieldPropagator->IsLastStepInVolume() : crossed;
  fParticleChange.ProposeFirstStepInVolume(fFirstStepInVolume);
  fParticleChange.ProposeLastStepInVolume(fLastStepInVolume);
  SetTouchableInformation(fCurrentTouchableHandle);
  return &fParticleChange;
}

Transportation* keep_touchables() {
  Transportation* made = nullptr;
  const WithoutWarningsOfTwoFirsts quiet(G4StateManager::GetStateManager()->GetExceptionHandler());
  auto* particles = G4ParticleTable::GetParticleTable()->GetIterator();
  particles->reset();
  while ((*particles)()) {
    G4ProcessManager* const manager = particles->value()->GetProcessManager();
    if (manager == nullptr) continue;
    G4Transportation* const before = plain_transportation(*manager);
    if (before == nullptr) continue;
    if (made == nullptr) {
      made = new Transportation;  // from here on Geant4's process table owns it
      made->SetThresholdWarningEnergy(before->GetThresholdWarningEnergy());
      made->SetThresholdImportantEnergy(before->GetThresholdImportantEnergy());
      made->SetThresholdTrials(before->GetThresholdTrials());
    }
    manager->RemoveProcess(before);
    manager->AddProcess(made);
    manager->SetProcessOrderingToFirst(made, idxAlongStep);
    manager->SetProcessOrderingToFirst(made, idxPostStep);
  }
  return made;
}

}  // namespace navjit::geant4
