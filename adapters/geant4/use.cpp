#include "navjit/geant4/use.hpp"

#include <G4StateManager.hh>
#include <G4TransportationManager.hh>

#include "navjit/geant4/shadow.hpp"

namespace navjit::geant4 {

namespace {

/// Once the run manager is initialised, processes and the stepping manager hold the navigator that
/// was there, while others ask for the present one: with two of them tracks go astray.
bool too_late() {
  if (G4StateManager::GetStateManager()->GetCurrentState() == G4State_PreInit) return false;
  G4Exception("navjit::geant4::use()", "navjit0003", JustWarning,
              "it is too late for navjit: call use() before the run manager is made. Geant4's own "
              "navigator stays");
  return true;
}

}  // namespace

void install(const std::shared_ptr<Session>& session) {
  G4TransportationManager* manager = G4TransportationManager::GetTransportationManager();
  G4Navigator* navigator = session->options().mode == Mode::shadow ? new ShadowNavigator(session)
                                                                   : new Navigator(session);
  // Geant4 deletes the navigators that it has; the previous one stays, as others may hold it.
  G4VPhysicalVolume* world = manager->GetNavigatorForTracking()->GetWorldVolume();
  if (world != nullptr) navigator->SetWorldVolume(world);
  navigator->Activate(true);
  manager->SetNavigatorForTracking(navigator);
}

std::shared_ptr<Session> use(Options options) {
  auto session = std::make_shared<Session>(std::move(options));
  if (!too_late()) install(session);
  return session;
}

std::shared_ptr<Session> use(G4VPhysicalVolume& world, Options options) {
  auto session = std::make_shared<Session>(std::move(options));
  session->engine(world);
  if (session->refusal().empty() && !too_late()) install(session);
  return session;
}

}  // namespace navjit::geant4
