// One line brings navjit into a program that uses Geant4.
#pragma once

#include <iosfwd>
#include <memory>

#include "navjit/geant4/session.hpp"

namespace navjit::geant4 {

/// Makes navjit the navigator of the calling thread, before the run manager is made:
///
///   auto session = navjit::geant4::use();
///   auto* run_manager = G4RunManagerFactory::CreateRunManager(G4RunManagerType::Serial);
///
/// The world is converted at the first call that locates a point in it. If it is refused, Geant4
/// gets one warning and its own navigation continues. Multithreaded programs also give the run
/// manager a WorkerInitialization (navjit/geant4/worker.hpp).
std::shared_ptr<Session> use(Options options = {});
/// The same for a world that is already known: it is converted at once, and if it is refused
/// nothing is installed.
std::shared_ptr<Session> use(G4VPhysicalVolume& world, Options options = {});
/// The same for one more thread, which shares the session. Call it before the run manager of that
/// thread is made. Processes that were made before keep the navigator that they have.
void install(const std::shared_ptr<Session>& session);

/// For the end of a run: prints how often Geant4 asked what, how much that took of the processor
/// time since the session was made, what differed in shadow mode, and the hottest volumes.
void print_report(Session& session, std::ostream& out);

}  // namespace navjit::geant4
