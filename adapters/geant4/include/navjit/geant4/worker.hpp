// For multithreaded runs; needs Geant4's run library and its processes/transportation.
#pragma once

#include <G4UserWorkerInitialization.hh>
#include <memory>

#include "navjit/geant4/transportation.hpp"
#include "navjit/geant4/use.hpp"

namespace navjit::geant4 {

/// Makes navjit the navigator of each worker thread:
///
///   run_manager->SetUserInitialization(new navjit::geant4::WorkerInitialization(session));
///
/// A program that has a class of its own calls install() in its WorkerInitialize() and, if
/// touchables are to be kept, keep_touchables() in its WorkerRunStart().
class WorkerInitialization : public G4UserWorkerInitialization {
 public:
  explicit WorkerInitialization(std::shared_ptr<Session> session,
                                Touchables touchables = Touchables::made)
      : session_(std::move(session)), touchables_(touchables) {}
  void WorkerInitialize() const override { install(session_); }
  void WorkerRunStart() const override {
    // A thread that has replaced its transportation before finds nothing more to replace.
    if (touchables_ == Touchables::kept) keep_touchables();
  }

 private:
  std::shared_ptr<Session> session_;
  Touchables touchables_;
};

}  // namespace navjit::geant4
