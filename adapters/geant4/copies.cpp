#include "adapters/geant4/copies.hpp"

#include <G4LogicalVolume.hh>
#include <G4PhantomParameterisation.hh>
#include <G4ReplicaNavigation.hh>
#include <G4Tubs.hh>
#include <G4VPVParameterisation.hh>
#include <G4VSolid.hh>

#include "navjit/geant4/geometry.hpp"

namespace navjit::geant4 {
namespace {

[[noreturn]] void refuse(const G4VPhysicalVolume& volume, const std::string& why) {
  throw Unsupported("volume '" + volume.GetName() + "': " + why);
}

/// Each copy becomes a placement, which takes 1600 bytes with all that navigation needs of it.
constexpr G4int most_copies = 1 << 20;

void require_few(const G4VPhysicalVolume& volume, G4int count) {
  if (count > most_copies) {
    refuse(volume, "it has " + std::to_string(count) + " copies: navjit takes " +
                       std::to_string(most_copies) + " in one volume");
  }
}

struct Replication {
  EAxis axis;
  G4int count;
  G4double width, offset;
  G4bool consuming;

  explicit Replication(const G4VPhysicalVolume& volume) {
    volume.GetReplicationData(axis, count, width, offset, consuming);
  }
};

/// Rings: Geant4 takes their radii from the replication, and everything else from the solid.
Solid ring(const G4VPhysicalVolume& volume, const G4VSolid& solid, const Replication& replication,
           G4int number) {
  const auto* tubs = dynamic_cast<const G4Tubs*>(&solid);
  if (tubs == nullptr) refuse(volume, "replicas along the radius have to be of a G4Tubs");
  const double rmin = replication.offset + number * replication.width;
  return make_tube(solid.GetName() + "_" + std::to_string(number), rmin, rmin + replication.width,
                   tubs->GetZHalfLength(), tubs->GetStartPhiAngle(), tubs->GetDeltaPhiAngle());
}

void for_each_replica(G4VPhysicalVolume& volume, const std::function<void(const Copy&)>& take) {
  const Replication replication(volume);
  require_few(volume, replication.count);
  const G4LogicalVolume& logical = *volume.GetLogicalVolume();
  G4ReplicaNavigation navigation;
  for (G4int i = 0; i < replication.count; ++i) {
    navigation.ComputeTransformation(i, &volume);
    Copy copy{i, logical.GetSolid(), logical.GetMaterial(), true};
    if (replication.axis == kRho) copy.shape = ring(volume, *copy.solid, replication, i);
    take(copy);
  }
}

void for_each_parameterised(G4VPhysicalVolume& volume,
                            const std::function<void(const Copy&)>& take) {
  G4VPVParameterisation* parameterisation = volume.GetParameterisation();
  if (parameterisation == nullptr) refuse(volume, "it has no parameterisation");
  const auto* phantom = dynamic_cast<const G4PhantomParameterisation*>(parameterisation);
  if (volume.GetRegularStructureId() != 0 && phantom != nullptr && phantom->SkipEqualMaterials()) {
    refuse(volume,
           "it is a regular structure whose boundaries Geant4 skips where materials agree: navjit "
           "stops at all of them, after SetSkipEqualMaterials(false)");
  }
  const G4int count = Replication(volume).count;
  require_few(volume, count);
  for (G4int i = 0; i < count; ++i) {
    G4VSolid* solid = parameterisation->ComputeSolid(i, &volume);
    solid->ComputeDimensions(parameterisation, i, &volume);
    parameterisation->ComputeTransformation(i, &volume);
    // If a material depends on the mother's copy, Geant4 looks for it at each entrance; navjit
    // needs no material.
    const G4Material* material = parameterisation->IsNested()
                                     ? volume.GetLogicalVolume()->GetMaterial()
                                     : parameterisation->ComputeMaterial(i, &volume, nullptr);
    take({i, solid, material, phantom == nullptr});
  }
}

}  // namespace

void for_each_copy(G4VPhysicalVolume& volume, const std::function<void(const Copy&)>& take) {
  switch (volume.VolumeType()) {
    case kReplica:
      return for_each_replica(volume, take);
    case kParameterised:
      return for_each_parameterised(volume, take);
    default:
      refuse(volume, "it is an external volume");
  }
}

}  // namespace navjit::geant4
