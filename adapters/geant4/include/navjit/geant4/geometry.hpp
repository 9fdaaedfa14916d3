// A detector of Geant4, converted from its volumes in memory.
#pragma once

#include <G4VPhysicalVolume.hh>
#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "navjit/detector.hpp"

namespace navjit::geant4 {

/// Something that navjit has no counterpart for; what() names the volume and the obstacle.
struct Unsupported : Error {
  using Error::Error;
};

/// How Geant4 identifies a daughter: one placement, or one copy of a replica or parameterisation.
struct Placed {
  G4VPhysicalVolume* volume;
  G4int number;  ///< copy or replica number
  EVolume type;
  VolumeId id;         ///< the daughter's volume in the Detector
  TouchableId offset;  ///< the touchable's number minus that of the mother
};

/// The Detector made from a world of Geant4, and the way back to Geant4's placements. Each logical
/// volume becomes one volume; a parameterisation that changes solid or material gives one for each
/// that differs. Sensitive detectors and roots of regions get the tags that observation reads
/// (navjit/observation.hpp): those of the thread that converts. This object keeps pointers into
/// Geant4: the world must not change. Immutable.
class Geometry {
 public:
  /// Afterwards Geant4's solids may be in any state of their parameterisations, as they are after
  /// Geant4's own navigation. Throws Unsupported or GeometryError.
  explicit Geometry(G4VPhysicalVolume& world);

  const Detector& detector() const { return detector_; }
  G4VPhysicalVolume& world() const { return *world_; }
  /// Names of the volumes for whose solid, or a part of it, Geant4 itself is asked.
  const std::vector<std::string>& asked_of_geant4() const { return asked_; }
  /// Whether there are only placements, no replicas and no parameterisations.
  bool plain() const { return plain_; }

  const Placed& placed(VolumeId mother, std::uint32_t daughter) const {
    return placed_[first_[mother] + daughter];
  }
  /// The daughter that Geant4 identifies by these two; null if there is none.
  const Placed* find(VolumeId mother, const G4VPhysicalVolume& volume, G4int number) const {
    const auto instance = static_cast<std::size_t>(volume.GetInstanceID());
    if (instance < only_.size() && only_[instance].mother == mother) {
      const Placed& placed = placed_[only_[instance].at];
      if (placed.volume == &volume && placed.number == number) return &placed;
    }
    return find_copy(mother, volume, number);
  }

 private:
  friend struct Conversion;
  struct Key {
    const G4VPhysicalVolume* volume;
    G4int number;
    VolumeId mother;
    bool operator==(const Key&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Key& key) const;
  };

  /// A placement that occurs once, in one volume of the Detector.
  struct Only {
    VolumeId mother = none;
    std::uint32_t at = none;  ///< index into placed_; `none`: not seen yet
  };
  static constexpr std::uint32_t none = static_cast<std::uint32_t>(-1);

  Geometry(Detector detector, const std::vector<std::vector<Placed>>& daughters,
           std::vector<std::string> asked, G4VPhysicalVolume& world);
  const Placed* find_copy(VolumeId mother, const G4VPhysicalVolume& volume, G4int number) const;
  void add_only(const Placed& placed, VolumeId mother, std::uint32_t at);

  Detector detector_;
  std::vector<Placed> placed_;        ///< all daughters; those of a mother follow one another
  std::vector<std::uint32_t> first_;  ///< index into placed_, by mother
  /// By Geant4's number of the placement: this reads one line of memory, a hash several.
  std::vector<Only> only_;
  std::vector<std::string> asked_;
  std::unordered_map<Key, std::uint32_t, Hash> copies_;  ///< in placed_: what is not in only_
  G4VPhysicalVolume* world_;
  bool plain_ = true;
};

}  // namespace navjit::geant4
