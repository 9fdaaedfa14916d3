// For multithreaded runs; needs Geant4's run library.
#pragma once

#include <G4UserWorkerInitialization.hh>
#include <memory>

#include "navjit/geant4/use.hpp"

namespace navjit::geant4 {

/// Makes navjit the navigator of each worker thread:
///
///   run_manager->SetUserInitialization(new navjit::geant4::WorkerInitialization(session));
///
/// A program that has a class of its own calls install() in its WorkerInitialize().
class WorkerInitialization : public G4UserWorkerInitialization {
 public:
  explicit WorkerInitialization(std::shared_ptr<Session> session) : session_(std::move(session)) {}
  void WorkerInitialize() const override { install(session_); }

 private:
  std::shared_ptr<Session> session_;
};

}  // namespace navjit::geant4
