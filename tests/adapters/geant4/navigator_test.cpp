// Calls of Geant4 that walks do not make, and how navjit gets into a program.
#include "navjit/geant4/navigator.hpp"

#include <gtest/gtest.h>
#include <G4Box.hh>
#include <G4GeometryManager.hh>
#include <G4LogicalVolume.hh>
#include <G4PVParameterised.hh>
#include <G4PVPlacement.hh>
#include <G4PVReplica.hh>
#include <G4StateManager.hh>
#include <G4TouchableHistory.hh>
#include <G4TransportationManager.hh>
#include <G4VExceptionHandler.hh>
#include <G4VPVParameterisation.hh>

#include <cmath>
#include <memory>
#include <sstream>
#include <thread>
#include <vector>

#include "navjit/geant4/use.hpp"

namespace navjit {
namespace {

/// A hall of half width 100 with a box of 20 in its middle, and a box of 5 in the middle of that.
struct Boxes {
  G4LogicalVolume* hall = new G4LogicalVolume(new G4Box("hall", 100, 100, 100), nullptr, "hall");
  G4LogicalVolume* outer = new G4LogicalVolume(new G4Box("outer", 20, 20, 20), nullptr, "outer");
  G4LogicalVolume* inner = new G4LogicalVolume(new G4Box("inner", 5, 5, 5), nullptr, "inner");
  G4VPhysicalVolume* world = new G4PVPlacement(nullptr, {}, hall, "hall", nullptr, false, 0);

  Boxes() {
    new G4PVPlacement(nullptr, {}, outer, "outer", hall, false, 4);
    new G4PVPlacement(nullptr, {}, inner, "inner", outer, false, 6);
  }
};

class Calls : public testing::Test {
 protected:
  Calls() { navigator_.SetWorldVolume(boxes_.world); }

  std::string locate(const G4ThreeVector& point, const G4ThreeVector& direction, bool relative) {
    return name(navigator_.LocateGlobalPointAndSetup(point, &direction, relative, false));
  }
  static std::string name(const G4VPhysicalVolume* volume) {
    return volume == nullptr ? "outside" : std::string(volume->GetName());
  }

  static G4LogicalVolume* inner_alone() {
    return new G4LogicalVolume(new G4Box("late", 5, 5, 5), nullptr, "late");
  }

  Boxes boxes_;
  std::shared_ptr<geant4::Session> session_ =
      std::make_shared<geant4::Session>(geant4::Options{.mode = geant4::Mode::navjit});
  geant4::Navigator navigator_{session_};
  const G4ThreeVector x_{1, 0, 0}, y_{0, 1, 0};
};

TEST_F(Calls, ThroughTheWorldAndOut) {
  EXPECT_EQ(locate({-50, 0, 0}, x_, false), "hall");
  G4ThreeVector point(-50, 0, 0);
  const std::pair<double, const char*> steps[] = {
      {30, "outer"}, {15, "inner"}, {10, "outer"}, {15, "hall"}, {80, "outside"}};
  for (const auto& [length, next] : steps) {
    double safety = -1;
    EXPECT_DOUBLE_EQ(navigator_.ComputeStep(point, x_, 500, safety), length);
    EXPECT_GE(safety, 0);
    EXPECT_LE(safety, length);
    point += length * x_;
    EXPECT_EQ(navigator_.ComputeSafety(point), 0);
    navigator_.SetGeometricallyLimitedStep();
    G4TouchableHandle touchable = navigator_.CreateTouchableHistoryHandle();
    navigator_.LocateGlobalPointAndUpdateTouchableHandle(point, x_, touchable, true);
    EXPECT_EQ(name(touchable->GetVolume()), next);
    const bool deeper = length == 30 || length == 15;
    EXPECT_EQ(navigator_.EnteredDaughterVolume(), deeper && std::string(next) != "hall");
    EXPECT_EQ(navigator_.ExitedMotherVolume(), !navigator_.EnteredDaughterVolume());
    G4bool valid = false;
    EXPECT_EQ(navigator_.GetGlobalExitNormal(point, &valid), x_);
    EXPECT_TRUE(valid);
    EXPECT_EQ(navigator_.GetLocalExitNormal(&valid), x_);
  }
  EXPECT_FALSE(navigator_.state().inside());
}

TEST_F(Calls, TracksStartOnTheWorldsFace) {
  EXPECT_EQ(locate({-100, 0, 0}, x_, false), "hall");
  double safety = 0;
  EXPECT_DOUBLE_EQ(navigator_.ComputeStep({-100, 0, 0}, x_, 500, safety), 80);
  EXPECT_EQ(locate({100, 3, 0}, -x_, false), "hall");
  EXPECT_DOUBLE_EQ(navigator_.ComputeStep({100, 3, 0}, -x_, 500, safety), 80);
}

TEST_F(Calls, TracksComeInFromOutsideTheWorld) {
  G4GeometryManager::GetInstance()->CloseGeometry(true, false);
  EXPECT_EQ(locate({-130, 3, 0}, x_, false), "outside");
  double safety = 0;
  const double length = navigator_.ComputeStep({-130, 3, 0}, x_, 500, safety);
  EXPECT_NEAR(length, 110, 1e-9);
  navigator_.SetGeometricallyLimitedStep();
  EXPECT_EQ(locate({-130 + length, 3, 0}, x_, true), "outer");
  EXPECT_NEAR(navigator_.ComputeStep({-20, 3, 0}, x_, 500, safety), 15, 1e-9);
  G4GeometryManager::GetInstance()->OpenGeometry();
}

TEST_F(Calls, PhysicsThatLimitsIsInfinity) {
  locate({-50, 0, 0}, x_, false);
  double safety = 0;
  EXPECT_EQ(navigator_.ComputeStep({-50, 0, 0}, x_, 29.9, safety), kInfinity);
  EXPECT_FALSE(navigator_.EnteredDaughterVolume());
  navigator_.LocateGlobalPointWithinVolume({-20.1, 0, 0});
  EXPECT_NEAR(navigator_.ComputeSafety({-20.1, 0, 0}), 0.1, 1e-9);
  // As Geant4's own, it does not stop at what would be enough.
  EXPECT_NEAR(navigator_.ComputeSafety({-20.1, 3, 0}, 0.05), 0.1, 1e-9);
  G4bool valid = true;
  navigator_.GetGlobalExitNormal({-20.1, 0, 0}, &valid);
  EXPECT_FALSE(valid);
}

TEST_F(Calls, AStepThatIsOnlyCheckedChangesNothing) {
  for (const G4ThreeVector& aside : {y_, -x_, x_}) {
    locate({-50, 0, 0}, x_, false);
    double safety = 0;
    EXPECT_EQ(navigator_.ComputeStep({-50, 0, 0}, x_, 500, safety), 30);
    navigator_.CheckNextStep({-50, 0, 0}, aside, 500, safety);
    navigator_.SetGeometricallyLimitedStep();
    EXPECT_EQ(locate({-20, 0, 0}, x_, true), "outer");
    EXPECT_TRUE(navigator_.EnteredDaughterVolume());
    EXPECT_FALSE(navigator_.ExitedMotherVolume());
  }
}

TEST_F(Calls, ALocateWithinForgetsTheBoundary) {
  locate({-50, 0, 0}, x_, false);
  double safety = 0;
  navigator_.ComputeStep({-50, 0, 0}, x_, 500, safety);
  navigator_.LocateGlobalPointWithinVolume({-45, 0, 0});
  EXPECT_EQ(locate({-45, 0, 0}, x_, true), "hall");
  EXPECT_FALSE(navigator_.EnteredDaughterVolume());
}

TEST_F(Calls, BesideTheEndOfAStepTheTrackStillEnters) {
  // In a field the end is where a chord meets the boundary, to a micrometre.
  for (const double beside : {-1e-4, 1e-4}) {
    locate({-50, 0, 0}, x_, false);
    double safety = 0;
    navigator_.ComputeStep({-50, 0, 0}, x_, 500, safety);
    navigator_.SetGeometricallyLimitedStep();
    EXPECT_EQ(locate({-20 + beside, 0, 0}, x_, true), "outer");
    navigator_.ComputeStep({19, 0, 0}, x_, 500, safety);
    navigator_.SetGeometricallyLimitedStep();
    EXPECT_EQ(locate({20 + beside, 0, 0}, x_, true), "hall");
  }
}

TEST_F(Calls, SecondariesStartFromTheirTouchable) {
  locate({0, 0, 0}, x_, false);
  const G4TouchableHandle inner = navigator_.CreateTouchableHistoryHandle();
  EXPECT_EQ(inner->GetHistoryDepth(), 2);
  EXPECT_EQ(inner->GetReplicaNumber(1), 4);
  locate({-50, 0, 0}, x_, false);
  const auto& history = *static_cast<G4TouchableHistory*>(inner());
  EXPECT_EQ(name(navigator_.ResetHierarchyAndLocate({1, 2, 3}, x_, history)), "inner");
  EXPECT_EQ(navigator_.CreateTouchableHistoryHandle()->GetReplicaNumber(), 6);
  // On a face the direction decides.
  EXPECT_EQ(name(navigator_.ResetHierarchyAndLocate({5, 0, 0}, x_, history)), "outer");
  EXPECT_EQ(name(navigator_.ResetHierarchyAndLocate({5, 0, 0}, -x_, history)), "inner");
}

/// Keeps the exceptions that it is told of while it lives.
struct Handler : G4VExceptionHandler {
  Handler() = default;
  ~Handler() override { G4StateManager::GetStateManager()->SetExceptionHandler(nullptr); }
  Handler(const Handler&) = delete;
  Handler& operator=(const Handler&) = delete;
  std::string codes{};
  G4bool Notify(const char*, const char* code, G4ExceptionSeverity severity,
                const char* what) override {
    codes += code;
    EXPECT_EQ(severity, EventMustBeAborted) << what;
    return false;
  }
};

TEST_F(Calls, NumbersThatAreNoneAbortTheEvent) {
  const Handler handler;
  locate({-50, 0, 0}, x_, false);
  double safety = 0;
  EXPECT_EQ(navigator_.ComputeStep({-50, 0, 0}, 2 * x_, 500, safety), kInfinity);
  EXPECT_EQ(navigator_.ComputeStep({std::nan(""), 0, 0}, x_, 500, safety), kInfinity);
  EXPECT_EQ(locate({0, std::nan(""), 0}, x_, true), "outside");
  EXPECT_EQ(navigator_.ComputeSafety({0, 0, std::nan("")}), 0);
  EXPECT_EQ(handler.codes, "navjit0003navjit0003navjit0003navjit0003");
  // It is as good as before.
  EXPECT_EQ(navigator_.ComputeStep({-50, 0, 0}, x_, 500, safety), 30);
}

TEST_F(Calls, AWorldThatChangedIsConvertedAnew) {
  EXPECT_EQ(locate({60, 0, 0}, x_, false), "hall");
  new G4PVPlacement(nullptr, {60, 0, 0}, inner_alone(), "late", boxes_.hall, false, 9);
  EXPECT_EQ(locate({60, 0, 0}, x_, false), "hall");
  session_->geometry_changed();
  EXPECT_EQ(locate({60, 0, 0}, x_, false), "late");
}

TEST_F(Calls, AreCountedForWhoeverReadsMeanwhile) {
  const auto counted = [&] {
    return std::uint64_t{session_->counts().calls[static_cast<int>(geant4::Call::locate)].calls};
  };
  constexpr std::uint64_t calls = 20000;
  std::thread reader([&] {
    for (std::uint64_t last = 0; last < calls;) {
      const std::uint64_t now = counted();
      EXPECT_GE(now, last);
      last = now;
    }
  });
  for (std::uint64_t i = 0; i < calls; ++i) locate({0, 0, 0}, x_, false);
  reader.join();
  EXPECT_EQ(counted(), calls);
}

TEST_F(Calls, AStackThatWasResetIsThatOfTheWorld) {
  EXPECT_EQ(locate({0, 0, 0}, x_, false), "inner");
  navigator_.ResetStackAndState();
  EXPECT_EQ(navigator_.depth(), 0U);
  EXPECT_EQ(locate({1, 0, 0}, x_, true), "inner");
  EXPECT_EQ(navigator_.depth(), 2U);
  EXPECT_EQ(locate({10, 0, 0}, x_, true), "outer");
}

TEST_F(Calls, ExternalVolumesOfOthersAreRefused) {
  boxes_.outer->ChangeDaughtersType(kExternal);
  const auto session = std::make_shared<geant4::Session>(geant4::Options{});
  EXPECT_EQ(session->engine(*boxes_.world), nullptr);
  EXPECT_NE(session->refusal().find("'outer'"), std::string::npos) << session->refusal();
}

/// A class of a user's, whose text says nothing of its size.
class Silent : public G4Box {
 public:
  using G4Box::G4Box;
  std::ostream& StreamInfo(std::ostream& out) const override { return out << "Silent"; }
  G4VSolid* Clone() const override { return new Silent(*this); }
  G4GeometryType GetEntityType() const override { return "Silent"; }
};

/// Boxes of half widths 2, 5 and 10, at -40, 0 and 40 along x.
class Growing : public G4VPVParameterisation {
 public:
  void ComputeTransformation(G4int n, G4VPhysicalVolume* volume) const override {
    volume->SetTranslation({-40.0 + 40 * n, 0, 0});
  }
  G4VSolid* ComputeSolid(G4int n, G4VPhysicalVolume*) override { return solids_[n]; }
  G4VSolid* first() const { return solids_[0]; }

 private:
  G4VSolid* solids_[3] = {new Silent("s", 2, 2, 2), new Silent("s", 5, 5, 5),
                          new Silent("s", 10, 10, 10)};
};

/// Where a ray along x from (-90, 0.5, 0.5) crosses boundaries.
std::vector<G4double> crossings(G4Navigator& navigator) {
  const G4ThreeVector x(1, 0, 0);
  G4ThreeVector point(-90, 0.5, 0.5);
  std::vector<G4double> all;
  G4VPhysicalVolume* in = navigator.LocateGlobalPointAndSetup(point, &x, false, false);
  while (in != nullptr && all.size() < 20) {
    G4double safety = 0;
    point += navigator.ComputeStep(point, x, 1000, safety) * x;
    all.push_back(std::round(point.x() * 1e6) / 1e6);
    navigator.SetGeometricallyLimitedStep();
    in = navigator.LocateGlobalPointAndSetup(point, &x);
  }
  return all;
}

TEST(Copies, OfAUsersClassThatSaysNothingOfItsSizeAreToldApart) {
  auto* hall = new G4LogicalVolume(new G4Box("hall", 100, 100, 100), nullptr, "hall");
  auto* world = new G4PVPlacement(nullptr, {}, hall, "hall", nullptr, false, 0);
  auto* growing = new Growing;
  new G4PVParameterised("d", new G4LogicalVolume(growing->first(), nullptr, "d"), hall, kXAxis, 3,
                        growing);
  G4GeometryManager::GetInstance()->CloseGeometry(true, false);
  geant4::Navigator ours(std::make_shared<geant4::Session>(geant4::Options{}));
  ours.SetWorldVolume(world);
  EXPECT_EQ(crossings(ours), (std::vector<G4double>{-42, -38, -5, 5, 30, 50, 100}));
  EXPECT_TRUE(ours.active());
  G4GeometryManager::GetInstance()->OpenGeometry();
}

TEST(Copies, ATrackThatIsResumedOnAFaceStaysInItsCopy) {
  auto* hall = new G4LogicalVolume(new G4Box("hall", 50, 50, 50), nullptr, "hall");
  auto* world = new G4PVPlacement(nullptr, {}, hall, "hall", nullptr, false, 0);
  auto* slab = new G4LogicalVolume(new G4Box("slab", 5, 50, 50), nullptr, "slab");
  new G4PVReplica("slabs", slab, hall, kXAxis, 10, 10);
  G4GeometryManager::GetInstance()->CloseGeometry(true, false);
  G4Navigator theirs;
  geant4::Navigator ours(std::make_shared<geant4::Session>(geant4::Options{}));
  const G4ThreeVector x(1, 0, 0), face(10, 1, 2);
  for (G4Navigator* navigator : {&theirs, static_cast<G4Navigator*>(&ours)}) {
    navigator->SetWorldVolume(world);
    navigator->LocateGlobalPointAndSetup({9, 1, 2}, &x, false, false);
    const std::unique_ptr<G4TouchableHistory> touchable(navigator->CreateTouchableHistory());
    ASSERT_EQ(touchable->GetReplicaNumber(), 5);
    navigator->LocateGlobalPointAndSetup({-30, 1, 2}, &x, false, false);
    navigator->ResetHierarchyAndLocate(face, x, *touchable);
    const std::unique_ptr<G4TouchableHistory> resumed(navigator->CreateTouchableHistory());
    EXPECT_EQ(resumed->GetReplicaNumber(), 5) << (navigator == &ours ? "navjit" : "Geant4");
  }
  EXPECT_TRUE(ours.active());
  G4GeometryManager::GetInstance()->OpenGeometry();
}

TEST(Use, IsTooLateOnceTheRunManagerIsInitialised) {
  G4TransportationManager* manager = G4TransportationManager::GetTransportationManager();
  G4Navigator* before = manager->GetNavigatorForTracking();
  G4StateManager* states = G4StateManager::GetStateManager();
  states->SetNewState(G4State_Init);
  states->SetNewState(G4State_Idle);
  geant4::use();
  EXPECT_EQ(manager->GetNavigatorForTracking(), before);
  states->SetNewState(G4State_PreInit);
}

TEST(Use, InstallsAndConvertsTheWorldOnce) {
  const Boxes boxes;
  const auto session = geant4::use(*boxes.world);
  const auto active = [&] {
    G4Navigator* navigator =
        G4TransportationManager::GetTransportationManager()->GetNavigatorForTracking();
    navigator->SetWorldVolume(boxes.world);
    const G4VPhysicalVolume* found =
        navigator->LocateGlobalPointAndSetup({0, 0, 0}, nullptr, false);
    EXPECT_EQ(found->GetName(), "inner");
    const auto* ours = dynamic_cast<const geant4::Navigator*>(navigator);
    return ours != nullptr && ours->active();
  };
  EXPECT_TRUE(active());
  const auto engine = session->present_engine();
  G4GeometryManager::GetInstance()->CloseGeometry(true, false);
  EXPECT_EQ(session->present_engine(), engine);
  EXPECT_EQ(session->counts().calls[static_cast<std::size_t>(geant4::Call::locate)].calls, 1U);
  std::ostringstream report;
  geant4::print_report(*session, report);
  EXPECT_NE(report.str().find("LocateGlobalPointAndSetup"), std::string::npos) << report.str();
  // As a run manager at its end: with its navigators goes the session, and the compiler's thread.
  delete G4TransportationManager::GetTransportationManager();
}

TEST(Use, LeavesGeant4WhereTheWorldIsRefused) {
  class Odd : public G4Box {  // one that does not say how large it is
   public:
    using G4Box::G4Box;
    G4bool CalculateExtent(const EAxis, const G4VoxelLimits&, const G4AffineTransform&, G4double&,
                           G4double&) const override {
      return false;
    }
  };
  auto* hall = new G4LogicalVolume(new Odd("odd", 100, 100, 100), nullptr, "hall");
  auto* world = new G4PVPlacement(nullptr, {}, hall, "hall", nullptr, false, 0);
  G4TransportationManager* manager = G4TransportationManager::GetTransportationManager();
  G4Navigator* before = manager->GetNavigatorForTracking();
  const auto session = geant4::use(*world);
  EXPECT_EQ(manager->GetNavigatorForTracking(), before);
  EXPECT_NE(session->refusal().find("'odd'"), std::string::npos) << session->refusal();
}

}  // namespace
}  // namespace navjit
