#include "navjit/geant4/use.hpp"

#include <G4TransportationManager.hh>

#include "navjit/geant4/shadow.hpp"

namespace navjit::geant4 {

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
  install(session);
  return session;
}

std::shared_ptr<Session> use(G4VPhysicalVolume& world, Options options) {
  auto session = std::make_shared<Session>(std::move(options));
  session->engine(world);
  if (session->refusal().empty()) install(session);
  return session;
}

}  // namespace navjit::geant4
