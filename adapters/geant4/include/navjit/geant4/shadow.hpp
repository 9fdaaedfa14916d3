// Runs both navigators side by side.
#pragma once

#include "navjit/geant4/navigator.hpp"

namespace navjit::geant4 {

/// Gives navjit's answers. Geant4's own navigator is asked the same; what differs is counted, and
/// printed with the touchable (Differences). After a difference Geant4's navigator is set to
/// navjit's place, so that each difference is counted once.
class ShadowNavigator : public Navigator {
 public:
  explicit ShadowNavigator(std::shared_ptr<Session> session);

 protected:
  G4double step(const G4ThreeVector& point, const G4ThreeVector& direction, G4double limit,
                G4double& safety) override;
  G4VPhysicalVolume* reset(const G4ThreeVector& point, const G4ThreeVector& direction,
                           const G4TouchableHistory& history) override;
  G4VPhysicalVolume* locate(const G4ThreeVector& point, const G4ThreeVector* direction,
                            bool relative, bool ignore_direction) override;
  void relocate_within(const G4ThreeVector& point) override;
  G4double safety_at(const G4ThreeVector& point, G4double enough) override;
  G4ThreeVector exit_normal(const Crossing& crossing) override;

 private:
  /// Geant4's navigator, which can be told where it is.
  struct Geant4 : G4Navigator {
    void set(const G4NavigationHistory& history, const G4ThreeVector& point);
    const G4NavigationHistory& history() const { return fHistory; }
  };

  /// What a locate was asked; it is printed with a difference.
  struct Circumstances {
    const G4NavigationHistory& before;
    const G4ThreeVector* direction;
    bool by_step;  ///< whether the step before it ended on a boundary
  };

  void compare_histories(const char* call, const G4ThreeVector& point,
                         const Circumstances& circumstances, G4VPhysicalVolume* ours,
                         G4VPhysicalVolume* theirs);
  void print(const char* call, const G4ThreeVector& point, const std::string& what);

  Geant4 geant4_;
  int to_print_;
};

}  // namespace navjit::geant4
