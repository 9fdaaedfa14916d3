#include "navjit/geant4/geometry.hpp"

#include <G4LogicalVolume.hh>
#include <G4RotationMatrix.hh>
#include <map>
#include <sstream>
#include <tuple>

#include "adapters/geant4/copies.hpp"
#include "adapters/geant4/materials.hpp"
#include "adapters/geant4/solids.hpp"

namespace navjit::geant4 {
namespace {

/// Of what a physical volume says now.
Transformation transformation(const G4VPhysicalVolume& volume) {
  const G4ThreeVector origin = volume.GetTranslation();
  const G4RotationMatrix* r = volume.GetRotation();
  if (r == nullptr) return placed_at({origin.x(), origin.y(), origin.z()});
  return make_transformation(
      {origin.x(), origin.y(), origin.z()},
      {r->xx(), r->xy(), r->xz(), r->yx(), r->yy(), r->yz(), r->zx(), r->zy(), r->zz()});
}

/// All of a solid that matters, as text: a parameterisation changes it in place.
std::string text_of(const G4VSolid& solid) {
  std::ostringstream text;
  text.precision(17);
  solid.StreamInfo(text);
  return std::move(text).str();
}

}  // namespace

/// A conversion under way: volumes whose daughters are not yet placed wait in a list.
struct Conversion {
  DetectorBuilder builder{};
  Materials materials{builder};
  std::vector<std::vector<Placed>> daughters{};
  std::vector<std::pair<VolumeId, const G4LogicalVolume*>> waiting{};
  std::map<const G4LogicalVolume*, VolumeId> plain{};
  std::map<std::tuple<const G4LogicalVolume*, std::string, const G4Material*>, VolumeId> variants{};

  VolumeId add(const G4LogicalVolume& logical, Solid solid, const G4Material* material) {
    const VolumeId id = builder.volume(logical.GetName(), std::move(solid), materials(material));
    builder.set_user_data(id, reinterpret_cast<std::uintptr_t>(&logical));
    daughters.resize(id + 1);
    waiting.emplace_back(id, &logical);
    return id;
  }

  Solid solid_of(const G4LogicalVolume& logical, const G4VSolid& solid) {
    try {
      return convert(solid);
    } catch (const Error& error) {
      throw Unsupported("volume '" + logical.GetName() + "': " + error.what());
    }
  }

  VolumeId volume(const G4LogicalVolume& logical) {
    const auto known = plain.find(&logical);
    if (known != plain.end()) return known->second;
    const VolumeId id = add(logical, solid_of(logical, *logical.GetSolid()), logical.GetMaterial());
    return plain[&logical] = id;
  }

  VolumeId volume(const G4LogicalVolume& logical, const Copy& copy) {
    if (copy.shape.shape) return add(logical, copy.shape, copy.material);
    const auto [known, added] =
        variants.try_emplace({&logical, text_of(*copy.solid), copy.material});
    if (added) known->second = add(logical, solid_of(logical, *copy.solid), copy.material);
    return known->second;
  }

  void place(VolumeId mother, G4VPhysicalVolume& physical, VolumeId id, G4int number) {
    builder.place(id, mother, transformation(physical), number, physical.GetName());
    daughters[mother].push_back({&physical, number, physical.VolumeType(), id, 0});
  }

  void place_daughters(VolumeId mother, const G4LogicalVolume& logical) {
    for (std::size_t i = 0; i < logical.GetNoDaughters(); ++i) {
      G4VPhysicalVolume& physical = *logical.GetDaughter(static_cast<G4int>(i));
      if (physical.VolumeType() == kNormal) {
        place(mother, physical, volume(*physical.GetLogicalVolume()), physical.GetCopyNo());
        continue;
      }
      for_each_copy(physical, [&](const Copy& copy) {
        place(mother, physical, volume(*physical.GetLogicalVolume(), copy), copy.number);
      });
    }
  }

  static Geometry run(G4VPhysicalVolume& world) {
    Conversion conversion;
    const VolumeId top = conversion.volume(*world.GetLogicalVolume());
    // The list grows while it is worked on.
    for (std::size_t i = 0; i < conversion.waiting.size(); ++i) {
      const auto [id, logical] = conversion.waiting[i];
      conversion.place_daughters(id, *logical);
    }
    return {conversion.builder.build(top), std::move(conversion.daughters), world};
  }
};

Geometry::Geometry(G4VPhysicalVolume& world) : Geometry(Conversion::run(world)) {}

Geometry::Geometry(Detector detector, std::vector<std::vector<Placed>> daughters,
                   G4VPhysicalVolume& world)
    : detector_(std::move(detector)), daughters_(std::move(daughters)), world_(&world) {
  for (VolumeId mother = 0; mother < daughters_.size(); ++mother) {
    const LogicalVolume& volume = detector_.volume(mother);
    for (std::uint32_t i = 0; i < daughters_[mother].size(); ++i) {
      Placed& placed = daughters_[mother][i];
      placed.offset = volume.daughters[i].offset;
      plain_ = plain_ && placed.type == kNormal;
      // Where two have the same number, Geant4 cannot tell them apart either.
      numbers_.try_emplace({placed.volume, placed.number, mother}, i);
    }
  }
}

const Placed* Geometry::find(VolumeId mother, const G4VPhysicalVolume* volume, G4int number) const {
  const auto found = numbers_.find({volume, number, mother});
  return found == numbers_.end() ? nullptr : &placed(mother, found->second);
}

std::size_t Geometry::Hash::operator()(const Key& key) const {
  const auto address = reinterpret_cast<std::uintptr_t>(key.volume) >> 4U;
  const std::uint64_t mixed =
      (address ^ (std::uint64_t{key.mother} << 40U) ^ static_cast<std::uint32_t>(key.number)) *
      0x9e3779b97f4a7c15U;
  return mixed ^ (mixed >> 29U);
}

}  // namespace navjit::geant4
