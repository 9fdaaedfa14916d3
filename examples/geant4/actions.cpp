#include "actions.hpp"

#include <G4Event.hh>
#include <G4ParticleGun.hh>
#include <G4ParticleTable.hh>
#include <G4Step.hh>
#include <G4SystemOfUnits.hh>
#include <G4UserEventAction.hh>
#include <G4UserSteppingAction.hh>
#include <G4VUserPrimaryGeneratorAction.hh>
#include <Randomize.hh>
#include <cmath>
#include <ctime>

namespace {

double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

class Primaries : public G4VUserPrimaryGeneratorAction {
 public:
  explicit Primaries(const Gun& gun) : gun_(gun) {
    shooter_.SetParticleDefinition(G4ParticleTable::GetParticleTable()->FindParticle(gun.particle));
    shooter_.SetParticleEnergy(gun.energy * GeV);
  }
  void GeneratePrimaries(G4Event* event) override {
    G4ThreeVector along = G4ThreeVector(gun_.along[0], gun_.along[1], gun_.along[2]).unit();
    G4ThreeVector from(gun_.from[0], gun_.from[1], gun_.from[2]);
    const G4ThreeVector u = along.orthogonal().unit(), v = along.cross(u);
    from += gun_.spread * ((2 * G4UniformRand() - 1) * u + (2 * G4UniformRand() - 1) * v);
    const double z = 1 - G4UniformRand() * (1 - std::cos(gun_.cone));
    const double phi = 2 * M_PI * G4UniformRand(), r = std::sqrt(1 - z * z);
    along = z * along + r * (std::cos(phi) * u + std::sin(phi) * v);
    shooter_.SetParticlePosition(from);
    shooter_.SetParticleMomentumDirection(along.unit());
    shooter_.GeneratePrimaryVertex(event);
  }

 private:
  const Gun& gun_;
  G4ParticleGun shooter_{1};
};

class Event : public G4UserEventAction {
 public:
  explicit Event(Sums& sums) : sums_(sums) {}
  void BeginOfEventAction(const G4Event* event) override {
    now_ = {.event = event->GetEventID(), .seconds = -thread_seconds()};
  }
  void EndOfEventAction(const G4Event*) override {
    now_.seconds += thread_seconds();
    const std::lock_guard lock(sums_.mutex);
    sums_.events.push_back(now_);
  }
  EventSums& now() { return now_; }

 private:
  Sums& sums_;
  EventSums now_{};
};

class Stepping : public G4UserSteppingAction {
 public:
  explicit Stepping(Event& event) : event_(event) {}
  void UserSteppingAction(const G4Step* step) override {
    EventSums& now = event_.now();
    ++now.steps;
    now.deposited += step->GetTotalEnergyDeposit() / MeV;
    const G4StepPoint* end = step->GetPostStepPoint();
    if (end->GetPhysicalVolume() == nullptr) now.leaked += end->GetKineticEnergy() / MeV;
  }

 private:
  Event& event_;
};

}  // namespace

void Actions::Build() const {
  SetUserAction(new Primaries(gun_));
  auto* event = new Event(sums_);
  SetUserAction(event);
  SetUserAction(new Stepping(*event));
}
