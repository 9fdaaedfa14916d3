#include "navjit/geant4/external.hpp"

#include <G4NavigationHistory.hh>
#include <G4PhysicalVolumeStore.hh>
#include <G4RotationMatrix.hh>

#include "adapters/geant4/guarded.hpp"
#include "adapters/geant4/materials.hpp"
#include "adapters/geant4/solids.hpp"
#include "adapters/geant4/transformation.hpp"
#include "adapters/geant4/vector.hpp"
#include "navjit/geant4/geometry.hpp"
#include "navjit/runtime.hpp"

namespace navjit::geant4 {

/// A detector in which the volume is the world, and its daughters have no daughters.
struct ExternalVolume {
  Detector detector;
  Runtime runtime;
  std::vector<G4VPhysicalVolume*> daughters;

  ExternalVolume(Detector made, const RuntimeOptions& options, std::vector<G4VPhysicalVolume*> of)
      : detector(std::move(made)), runtime(detector, options), daughters(std::move(of)) {}
  State mother() const { return {0, detector.world_volume()}; }
};

namespace {

/// Geant4 gives a parameterised volume the solid of one copy after the other, so that what is
/// converted would be the solid of whichever copy came last.
void refuse_parameterised(const G4LogicalVolume& logical) {
  for (const G4VPhysicalVolume* placed : *G4PhysicalVolumeStore::GetInstance()) {
    if (placed->GetLogicalVolume() != &logical || !placed->IsParameterised()) continue;
    throw Unsupported("volume '" + logical.GetName() + "': '" + placed->GetName() +
                      "' is parameterised, so that its solid may change; navigate the whole world");
  }
}

std::shared_ptr<ExternalVolume> make(const G4LogicalVolume& logical,
                                     const RuntimeOptions& options) {
  DetectorBuilder builder;
  Materials materials(builder);
  const auto add = [&](const G4LogicalVolume& volume) {
    refuse_parameterised(volume);
    ForeignSolids foreign;
    return builder.volume(volume.GetName(), convert(*volume.GetSolid(), foreign),
                          materials(volume.GetMaterial()));
  };
  const VolumeId mother = add(logical);
  std::unordered_map<const G4LogicalVolume*, VolumeId> known;
  std::vector<G4VPhysicalVolume*> daughters;
  for (std::size_t i = 0; i < logical.GetNoDaughters(); ++i) {
    G4VPhysicalVolume& daughter = *logical.GetDaughter(static_cast<G4int>(i));
    if (daughter.VolumeType() != kNormal) {
      throw Unsupported("volume '" + logical.GetName() + "': its daughter '" + daughter.GetName() +
                        "' is no placement");
    }
    const auto [at, is_new] = known.try_emplace(daughter.GetLogicalVolume());
    if (is_new) at->second = add(*daughter.GetLogicalVolume());
    builder.place(at->second, mother, transformation(daughter), daughter.GetCopyNo(),
                  daughter.GetName());
    daughters.push_back(&daughter);
  }
  return std::make_shared<ExternalVolume>(builder.build(mother), options, std::move(daughters));
}

}  // namespace

ExternalNavigation::ExternalNavigation(std::span<G4LogicalVolume* const> volumes,
                                       const RuntimeOptions& options) {
  auto made = std::make_shared<Volumes>();
  for (const G4LogicalVolume* volume : volumes) made->try_emplace(volume, make(*volume, options));
  for (G4LogicalVolume* volume : volumes) volume->ChangeDaughtersType(kExternal);
  volumes_ = std::move(made);
}

ExternalNavigation::ExternalNavigation(const ExternalNavigation& other)
    : G4VExternalNavigation(), volumes_(other.volumes_) {}

ExternalNavigation::~ExternalNavigation() = default;

G4VExternalNavigation* ExternalNavigation::Clone() { return new ExternalNavigation(*this); }

ExternalNavigation::Own& ExternalNavigation::own(const G4NavigationHistory& history) {
  const G4LogicalVolume* logical = history.GetTopVolume()->GetLogicalVolume();
  const auto known = own_.find(logical);
  if (known != own_.end()) return known->second;
  const auto found = volumes_->find(logical);
  if (found == volumes_->end()) {
    throw UsageError("volume '" + logical->GetName() +
                     "' is an external one, and not one of those that navjit was given");
  }
  ExternalVolume& volume = *found->second;
  return own_.try_emplace(logical, Own{&volume, volume.runtime.navigator()}).first->second;
}

G4bool ExternalNavigation::LevelLocate(G4NavigationHistory& history,
                                       const G4VPhysicalVolume* blocked,
                                       const G4int /*blocked_number*/, const G4ThreeVector& point,
                                       const G4ThreeVector* direction, const G4bool /*on_edge*/,
                                       G4ThreeVector& local_point) {
  return guarded(
      "navjit::geant4::ExternalNavigation::LevelLocate()",
      [&] {
        Own& at = own(history);
        const Vec3 along = direction == nullptr
                               ? Vec3{0, 0, 0}
                               : vector(history.GetTopTransform().TransformAxis(*direction));
        at.navigator.locate(vector(local_point), along);
        const auto levels = at.navigator.levels();
        if (levels.size() < 2) return false;
        G4VPhysicalVolume* daughter = at.volume->daughters[levels[1].daughter];
        if (daughter == blocked) return false;
        history.NewLevel(daughter, kNormal, daughter->GetCopyNo());
        local_point = history.GetTopTransform().TransformPoint(point);
        return true;
      },
      false);
}

G4double ExternalNavigation::ComputeStep(const G4ThreeVector& local_point,
                                         const G4ThreeVector& local_direction, const G4double limit,
                                         G4double& safety, G4NavigationHistory& history,
                                         G4bool& valid_normal, G4ThreeVector& normal,
                                         G4bool& exiting, G4bool& entering,
                                         G4VPhysicalVolume** entered, G4int& entered_number) {
  safety = 0;
  valid_normal = exiting = entering = false;
  *entered = nullptr;
  entered_number = -1;
  return guarded(
      "navjit::geant4::ExternalNavigation::ComputeStep()",
      [&]() -> G4double {
        Own& at = own(history);
        const State mother = at.volume->mother();
        const Vec3 from = vector(local_point), along = vector(local_direction);
        safety = at.navigator.safety(mother, from);
        const Step step = at.navigator.step(mother, from, along, limit);
        if (!step.boundary) return kInfinity;
        exiting = !step.next.inside();
        entering = !exiting;
        if (entering) {
          *entered = at.volume->daughters[at.navigator.levels()[1].daughter];
        } else {
          valid_normal = true;
          normal =
              vector(at.navigator.boundary_normal(mother, step.next, from + step.length * along));
          // Geant4 wants the normal in the frame of the volume's mother.
          const G4RotationMatrix* turn = history.GetTopVolume()->GetRotation();
          if (turn != nullptr) normal *= turn->inverse();
        }
        return step.length;
      },
      G4double{kInfinity});
}

G4double ExternalNavigation::ComputeSafety(const G4ThreeVector& local_point,
                                           const G4NavigationHistory& history,
                                           const G4double /*enough*/) {
  return guarded(
      "navjit::geant4::ExternalNavigation::ComputeSafety()",
      [&] {
        Own& at = own(history);
        return at.navigator.safety(at.volume->mother(), vector(local_point));
      },
      0.0);
}

}  // namespace navjit::geant4
