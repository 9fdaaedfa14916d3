#include "geant4_peer.hpp"

#include <G4GDMLParser.hh>
#include <G4GeometryManager.hh>
#include <G4LogicalVolume.hh>
#include <G4Navigator.hh>
#include <G4TouchableHistory.hh>
#include <G4VPhysicalVolume.hh>
#include <algorithm>
#include <stdexcept>

namespace navjit::peers {
namespace {

constexpr int zero_steps_allowed = 100;

G4ThreeVector to_geant4(const Vec3& v) { return {v.x, v.y, v.z}; }
G4ThreeVector to_geant4(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

}  // namespace

struct Geant4Peer::Own {
  G4GDMLParser parser{};
  mutable G4Navigator navigator{};

  /// Calls sink(volume, length) for each step.
  template <class Sink>
  void follow(const Ray& ray, const Sink& sink) const {
    G4ThreeVector point = to_geant4(ray.position);
    const G4ThreeVector direction = to_geant4(ray.direction);
    const G4VPhysicalVolume* in =
        navigator.LocateGlobalPointAndSetup(point, &direction, false, false);
    int standing = 0;
    while (in != nullptr) {
      G4double safety = 0;
      const G4double step = navigator.ComputeStep(point, direction, kInfinity, safety);
      standing = step > no_length ? 0 : standing + 1;
      if (standing == zero_steps_allowed || step >= kInfinity) return;
      sink(*in, step);
      point += step * direction;
      navigator.SetGeometricallyLimitedStep();
      in = navigator.LocateGlobalPointAndSetup(point, &direction, true, false);
    }
  }
};

Geant4Peer::Geant4Peer(const std::string& gdml_file) : own_(std::make_unique<Own>()) {
  own_->parser.SetStripFlag(false);
  own_->parser.Read(gdml_file, false);
  G4VPhysicalVolume* const world = own_->parser.GetWorldVolume();
  if (world == nullptr) throw std::runtime_error("Geant4 reads no world from " + gdml_file);
  G4GeometryManager::GetInstance()->CloseGeometry(true, false);
  own_->navigator.SetWorldVolume(world);
  own_->navigator.SetPushVerbosity(false);
}

Geant4Peer::~Geant4Peer() = default;

std::vector<Geant4Peer::Segment> Geant4Peer::trace(const Ray& ray) const {
  std::vector<Segment> segments;
  own_->follow(ray, [&](const G4VPhysicalVolume& in, double length) {
    segments.push_back({in.GetLogicalVolume()->GetName(), length});
  });
  return segments;
}

std::uint64_t Geant4Peer::transport(std::span<const Ray> rays) const {
  std::uint64_t steps = 0;
  for (const Ray& ray : rays) {
    own_->follow(ray, [&](const G4VPhysicalVolume&, double) { ++steps; });
  }
  return steps;
}

std::uint64_t Geant4Peer::fly(std::span<const Flight> flights, double& safeties) const {
  struct Place {
    std::unique_ptr<G4TouchableHistory> touchable;  ///< null: outside
    G4ThreeVector point;
    bool on_boundary;
  };
  G4Navigator& navigator = own_->navigator;
  std::uint64_t steps = 0;
  std::vector<Place> waiting;
  for (const Flight& flight : flights) {
    G4ThreeVector point = to_geant4(flight.start);
    const G4ThreeVector first = to_geant4(flight.steps.front().direction);
    const G4VPhysicalVolume* in = navigator.LocateGlobalPointAndSetup(point, &first, false, false);
    bool on_boundary = false;
    waiting.clear();
    for (const FlightStep& planned : flight.steps) {
      const G4ThreeVector direction = to_geant4(planned.direction);
      if (in != nullptr) {
        if (!on_boundary) safeties += navigator.ComputeSafety(point);
        for (int n = 0; n < zero_steps_allowed && in != nullptr; ++n) {
          G4double safety = 0;
          G4double step = navigator.ComputeStep(point, direction, planned.limit, safety);
          on_boundary = step <= planned.limit;
          step = std::min(step, planned.limit);
          point += step * direction;
          if (!on_boundary) {
            navigator.LocateGlobalPointWithinVolume(point);
            break;
          }
          navigator.SetGeometricallyLimitedStep();
          in = navigator.LocateGlobalPointAndSetup(point, &direction, true, false);
          if (step > no_length) break;
        }
        ++steps;
      }
      if (planned.secondary) {
        waiting.push_back({in == nullptr ? nullptr
                                         : std::unique_ptr<G4TouchableHistory>(
                                               navigator.CreateTouchableHistory()),
                           point, on_boundary});
      }
      if (planned.stops && !waiting.empty()) {
        const Place place = std::move(waiting.back());
        waiting.pop_back();
        point = place.point;
        on_boundary = place.on_boundary;
        in = place.touchable == nullptr
                 ? nullptr
                 : navigator.ResetHierarchyAndLocate(point, direction, *place.touchable);
      }
    }
  }
  return steps;
}

}  // namespace navjit::peers
