// Logical volumes and their placements.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "navjit/detail/api.hpp"
#include "navjit/solids.hpp"
#include "navjit/state.hpp"
#include "navjit/transformation.hpp"

namespace NAVJIT_API navjit {

/// A tag for the simulation; navigation does not read it. GDML's
/// `<auxiliary auxtype='...' auxvalue='...' auxunit='...'>`; the texts are the file's.
struct Auxiliary {
  std::string type, value, unit{};
  std::vector<Auxiliary> children{};
};

/// In the order of the file; null where there are none. Copies of their owner share them.
using Auxiliaries = std::shared_ptr<const std::vector<Auxiliary>>;

/// The first tag of that type; null if there is none.
inline const Auxiliary* find_auxiliary(const Auxiliaries& auxiliaries, std::string_view type) {
  if (!auxiliaries) return nullptr;
  for (const Auxiliary& auxiliary : *auxiliaries) {
    if (auxiliary.type == type) return &auxiliary;
  }
  return nullptr;
}

/// A daughter in its mother.
struct Placement {
  std::string name;
  VolumeId volume = 0;
  int copy_number = 0;
  Transformation transformation;  ///< from the mother's frame into the daughter's
  /// The number of a touchable of this daughter is that of the mother's touchable plus this.
  TouchableId offset = 0;
  std::uint64_t user_data = 0;  ///< the simulation's own number
  Auxiliaries auxiliaries{};
};

/// A solid filled with a material, and the daughters in it.
struct LogicalVolume {
  std::string name;
  Solid solid;
  std::uint32_t material = 0;        ///< a number below Detector::materials()
  std::vector<Placement> daughters;  ///< in file order
  /// Number of touchables in the tree below and including one placement of this volume; 0 where the
  /// volume is not in the world's tree.
  TouchableId touchables = 0;
  std::uint64_t user_data = 0;  ///< the simulation's own
  Auxiliaries auxiliaries{};
};

}  // namespace navjit
