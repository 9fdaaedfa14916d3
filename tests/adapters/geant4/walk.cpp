#include "tests/adapters/geant4/walk.hpp"

#include <gtest/gtest.h>

#include <G4GeometryManager.hh>
#include <G4LogicalVolume.hh>
#include <G4TouchableHistory.hh>
#include <G4VSolid.hh>
#include <cmath>
#include <deque>
#include <random>

#include "navjit/geant4/shadow.hpp"

namespace navjit::tests {
namespace {

/// A track that waits to be followed: where it starts, and in which touchable.
struct Secondary {
  G4ThreeVector point, direction;
  G4TouchableHandle touchable;
};

class Walker {
 public:
  Walker(G4VPhysicalVolume& world, Walk walk)
      : walk_(std::move(walk)),
        session_(std::make_shared<geant4::Session>(walk_.options)),
        navigator_(session_),
        random_(walk_.seed) {
    navigator_.SetWorldVolume(&world);
    world.GetLogicalVolume()->GetSolid()->BoundingLimits(low_, high_);
  }

  Walked run() {
    for (int i = 0; i < walk_.tracks; ++i) {
      G4ThreeVector point;
      for (int axis = 0; axis < 3; ++axis) {
        const double at = uniform(walk_.from[axis], walk_.to[axis]);
        point[axis] = (low_[axis] + high_[axis]) / 2 + at * (high_[axis] - low_[axis]) / 2;
      }
      const G4ThreeVector direction = any_direction();
      if (navigator_.LocateGlobalPointAndSetup(point, &direction, false, false) == nullptr)
        continue;
      track(point, direction);
      while (!secondaries_.empty()) {
        const Secondary next = secondaries_.front();
        secondaries_.pop_front();
        const auto& history = *static_cast<G4TouchableHistory*>(next.touchable());
        if (navigator_.ResetHierarchyAndLocate(next.point, next.direction, history) != nullptr) {
          track(next.point, next.direction);
        }
      }
    }
    walked_.counts = session_->counts();
    walked_.refusal = session_->refusal();
    return walked_;
  }

 private:
  double uniform(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }

  G4ThreeVector any_direction() {
    const double z = uniform(-1, 1), phi = uniform(0, 2 * M_PI);
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(phi), r * std::sin(phi), z};
  }

  void track(G4ThreeVector point, G4ThreeVector direction) {
    const bool straight = uniform(0, 1) < walk_.unlimited;
    int step = 0;
    for (; step < walk_.most_steps; ++step) {
      const double limit =
          straight
              ? DBL_MAX
              : std::exp(uniform(std::log(walk_.shortest_limit), std::log(walk_.longest_limit)));
      double safety = 0;
      const double length = navigator_.ComputeStep(point, direction, limit, safety);
      if (length > limit) {
        if (straight) break;  // it has left the world, and did not see it
        point += limit * direction;
        navigator_.LocateGlobalPointWithinVolume(point);
        scatter(point, direction);
        continue;
      }
      point += length * direction;
      navigator_.ComputeSafety(point);
      ++walked_.boundaries;
      navigator_.SetGeometricallyLimitedStep();
      const bool gone = navigator_.LocateGlobalPointAndSetup(point, &direction, true) == nullptr;
      G4bool valid = false;
      navigator_.GetGlobalExitNormal(point, &valid);
      if (!valid) ++walked_.without_normal;
      if (gone) return;
      if (!straight && uniform(0, 1) < 0.05) add_secondary(point);
    }
    if (straight && step == walk_.most_steps) ++walked_.stuck;
  }

  void scatter(G4ThreeVector& point, G4ThreeVector& direction) {
    if (uniform(0, 1) < 0.3) direction = any_direction();
    if (uniform(0, 1) < 0.1) add_secondary(point);
    if (uniform(0, 1) < 0.5) return;
    const double safety = navigator_.ComputeSafety(point);
    point += uniform(0, 0.99) * safety * any_direction();
    navigator_.LocateGlobalPointWithinVolume(point);
  }

  void add_secondary(const G4ThreeVector& point) {
    constexpr std::size_t most = 8;
    if (secondaries_.size() == most) return;
    secondaries_.push_back({point, any_direction(), navigator_.CreateTouchableHistoryHandle()});
  }

  Walk walk_;
  std::shared_ptr<geant4::Session> session_;
  geant4::ShadowNavigator navigator_;
  std::mt19937_64 random_;
  G4ThreeVector low_, high_;
  std::deque<Secondary> secondaries_;
  Walked walked_;
};

}  // namespace

Walked walk(G4VPhysicalVolume& world, Walk walk) {
  G4GeometryManager::GetInstance()->OpenGeometry();
  G4GeometryManager::GetInstance()->CloseGeometry(true, false);
  walk.options.mode = geant4::Mode::shadow;
  return Walker(world, std::move(walk)).run();
}

void expect_alike(G4VPhysicalVolume& world, const Walk& made) {
  const Walked walked = walk(world, made);
  EXPECT_EQ(walked.refusal, "");
  const geant4::Differences& found = walked.counts.differences;
  EXPECT_GT(found.steps, 20000U);
  EXPECT_LE(found.lengths + found.histories, found.steps / 20000);
  EXPECT_LT(found.largest_length, 1e-6);
  EXPECT_EQ(found.safeties, 0U);
  EXPECT_EQ(walked.without_normal, 0U);
  EXPECT_EQ(walked.stuck, 0U);
}

}  // namespace navjit::tests
