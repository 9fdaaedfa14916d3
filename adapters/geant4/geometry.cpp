#include "navjit/geant4/geometry.hpp"

#include <G4LogicalVolume.hh>
#include <G4Region.hh>
#include <G4VSensitiveDetector.hh>
#include <map>
#include <tuple>
#include <typeinfo>

#include "adapters/geant4/copies.hpp"
#include "adapters/geant4/materials.hpp"
#include "adapters/geant4/solids.hpp"
#include "adapters/geant4/transformation.hpp"

namespace navjit::geant4 {
namespace {

/// Geant4 holds a copy's solid in one state only, that of the copy which was computed last. A solid
/// that is asked itself therefore has to be copied.
const G4VSolid& own_copy(const G4VSolid& solid) {
  const G4VSolid* copy = solid.Clone();
  if (copy == nullptr || typeid(*copy) != typeid(solid)) {
    throw Unsupported("solid '" + solid.GetName() + "': navjit has none of the class " +
                      solid.GetEntityType() +
                      ", and for a parameterised volume the class needs a Clone() of its own");
  }
  return *copy;
}

void mark(DetectorBuilder& builder, VolumeId id, const G4LogicalVolume& logical) {
  if (const G4VSensitiveDetector* detector = logical.GetSensitiveDetector()) {
    builder.add_auxiliary(id, {.type = "SensDet", .value = detector->GetName()});
  }
  if (const G4Region* region = logical.GetRegion(); region != nullptr && logical.IsRootRegion()) {
    builder.add_auxiliary(id, {.type = "Region", .value = region->GetName()});
  }
}

}  // namespace

/// A conversion under way. Volumes whose daughters are not placed yet wait in a list.
struct Conversion {
  DetectorBuilder builder{};
  Materials materials{builder};
  std::vector<std::vector<Placed>> daughters{};
  std::vector<std::pair<VolumeId, const G4LogicalVolume*>> waiting{};
  std::map<const G4LogicalVolume*, VolumeId> plain{};
  std::map<std::tuple<const G4LogicalVolume*, std::string, const G4Material*>, VolumeId> variants{};
  std::vector<std::string> asked{};  ///< volumes whose solids Geant4 is asked for

  VolumeId add(const G4LogicalVolume& logical, Solid solid, const G4Material* material) {
    const VolumeId id = builder.volume(logical.GetName(), std::move(solid), materials(material));
    builder.set_user_data(id, reinterpret_cast<std::uintptr_t>(&logical));
    mark(builder, id, logical);
    daughters.resize(id + 1);
    waiting.emplace_back(id, &logical);
    return id;
  }

  /// `changing`: another copy changes this solid later.
  Solid solid_of(const G4LogicalVolume& logical, const G4VSolid& solid, bool changing) {
    try {
      ForeignSolids foreign;
      Solid converted = convert(solid, foreign);
      if (foreign.empty()) return converted;
      asked.push_back(logical.GetName());
      return changing ? convert(own_copy(solid), foreign) : converted;
    } catch (const Error& error) {
      throw Unsupported("volume '" + logical.GetName() + "': " + error.what());
    }
  }

  static bool is_foreign(const G4VSolid& solid) {
    ForeignSolids foreign;
    try {
      convert(solid, foreign);
    } catch (const Error&) {
      return false;  // refused where it is made
    }
    return !foreign.empty();
  }

  VolumeId volume(const G4LogicalVolume& logical) {
    const auto known = plain.find(&logical);
    if (known != plain.end()) return known->second;
    const VolumeId id =
        add(logical, solid_of(logical, *logical.GetSolid(), false), logical.GetMaterial());
    return plain[&logical] = id;
  }

  VolumeId volume(const G4LogicalVolume& logical, const Copy& copy) {
    if (copy.shape.shape) return add(logical, copy.shape, copy.material);
    // The text of a user's own class may say nothing of its dimensions.
    if (copy.changing && is_foreign(*copy.solid)) {
      return add(logical, solid_of(logical, *copy.solid, true), copy.material);
    }
    const auto [known, added] =
        variants.try_emplace({&logical, copy.changing ? text_of(*copy.solid) : "", copy.material});
    if (added) known->second = add(logical, solid_of(logical, *copy.solid, true), copy.material);
    return known->second;
  }

  void place(VolumeId mother, G4VPhysicalVolume& physical, VolumeId id, G4int number) {
    builder.place(id, mother, transformation(physical), number, physical.GetName());
    daughters[mother].push_back({&physical, number, physical.VolumeType(), id, 0});
  }

  void place_daughters(VolumeId mother, const G4LogicalVolume& logical) {
    if (logical.CharacteriseDaughters() == kExternal) {
      throw Unsupported("volume '" + logical.GetName() +
                        "': its daughters are navigated externally (kExternal)");
    }
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
    // Indices, since the list grows while the loop runs.
    for (std::size_t i = 0; i < conversion.waiting.size(); ++i) {
      const auto [id, logical] = conversion.waiting[i];
      conversion.place_daughters(id, *logical);
    }
    return {conversion.builder.build(top), conversion.daughters, std::move(conversion.asked),
            world};
  }
};

Geometry::Geometry(G4VPhysicalVolume& world) : Geometry(Conversion::run(world)) {}

Geometry::Geometry(Detector detector, const std::vector<std::vector<Placed>>& daughters,
                   std::vector<std::string> asked, G4VPhysicalVolume& world)
    : detector_(std::move(detector)), asked_(std::move(asked)), world_(&world) {
  for (VolumeId mother = 0; mother < daughters.size(); ++mother) {
    const LogicalVolume& volume = detector_.volume(mother);
    first_.push_back(static_cast<std::uint32_t>(placed_.size()));
    for (std::uint32_t i = 0; i < daughters[mother].size(); ++i) {
      Placed placed = daughters[mother][i];
      placed.offset = volume.daughters[i].offset;
      plain_ = plain_ && placed.type == kNormal;
      add_only(placed, mother, static_cast<std::uint32_t>(placed_.size()));
      placed_.push_back(placed);
    }
  }
  for (VolumeId mother = 0; mother < daughters.size(); ++mother) {
    for (std::uint32_t at = first_[mother]; at < first_[mother] + daughters[mother].size(); ++at) {
      const Placed& placed = placed_[at];
      if (only_[static_cast<std::size_t>(placed.volume->GetInstanceID())].mother == mother)
        continue;
      // If two have the same number, Geant4 cannot tell them apart either.
      copies_.try_emplace({placed.volume, placed.number, mother}, at);
    }
  }
}

void Geometry::add_only(const Placed& placed, VolumeId mother, std::uint32_t at) {
  const auto instance = static_cast<std::size_t>(placed.volume->GetInstanceID());
  if (instance >= only_.size()) only_.resize(instance + 1);
  Only& only = only_[instance];
  // This is a second daughter of the same placement: all of them are looked up by their numbers.
  only = only.at == none ? Only{mother, at} : Only{none, 0};
}

const Placed* Geometry::find_copy(VolumeId mother, const G4VPhysicalVolume& volume,
                                  G4int number) const {
  const auto found = copies_.find({&volume, number, mother});
  return found == copies_.end() ? nullptr : &placed_[found->second];
}

std::size_t Geometry::Hash::operator()(const Key& key) const {
  const auto address = reinterpret_cast<std::uintptr_t>(key.volume) >> 4U;
  const std::uint64_t mixed =
      (address ^ (std::uint64_t{key.mother} << 40U) ^ static_cast<std::uint32_t>(key.number)) *
      0x9e3779b97f4a7c15U;
  return mixed ^ (mixed >> 29U);
}

}  // namespace navjit::geant4
