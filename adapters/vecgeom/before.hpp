// Remembers what VecGeom's volumes had before they were given a navigator of navjit.
#pragma once

#include <VecGeom/navigation/VNavigator.h>
#include <VecGeom/navigation/VSafetyEstimator.h>
#include <VecGeom/volumes/LogicalVolume.h>

#include <unordered_map>

namespace navjit::vecgeom {

/// By volume. VecGeom asks some questions in a volume's own coordinates, without a state. They name
/// no touchable, and so are answered by what the volume had before. That is never a navigator of
/// navjit's: objects that are attached one over the other neither need nor call one another.
class Before {
 public:
  struct Had {
    const ::vecgeom::VNavigator* navigator = nullptr;
    const ::vecgeom::VSafetyEstimator* safety = nullptr;
  };
  std::unordered_map<const ::vecgeom::LogicalVolume*, Had> all{};

  /// What to remember of a volume that is about to be given a navigator of navjit's.
  static Had had(const ::vecgeom::LogicalVolume& volume);

  /// For volumes that had none, VecGeom's simple ones.
  const ::vecgeom::VNavigator& navigator(const ::vecgeom::LogicalVolume& volume,
                                         const ::vecgeom::VNavigator* not_this) const;
  const ::vecgeom::VSafetyEstimator& safety(const ::vecgeom::LogicalVolume& volume,
                                            const ::vecgeom::VSafetyEstimator* not_this) const;
};

}  // namespace navjit::vecgeom
