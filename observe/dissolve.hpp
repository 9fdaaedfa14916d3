// The rewriting of the tree: daughters that nothing observes give their daughters to their mothers.
#pragma once

#include <string>
#include <vector>

#include "observe/budget.hpp"
#include "observe/choose_mixtures.hpp"
#include "observe/marks.hpp"
#include "observe/worth_dissolving.hpp"

namespace navjit {

/// When it is worth it to dissolve a volume.
struct DissolveOptions {
  /// A volume with more daughters than this is a good place to look for them, and is kept, unless
  /// it is all that there is in its mother.
  std::size_t most_daughters = 3;
  /// Solids that overlap by less than this, mm, count as apart. No less than the rounding of
  /// positions in the world.
  double overlap = 1e-9;
  /// These daughters of these mothers are kept for speed.
  Pairs kept{};
};

/// The world without what nobody sees.
struct Dissolved {
  World world;  ///< finished; volumes have their numbers
  /// Of each daughter of each volume: what its touchable's number is in the original, less that of
  /// the mother.
  std::vector<std::vector<TouchableId>> offsets;
  /// Of each daughter of each volume of the original: whether it is in the tree no more.
  std::vector<std::vector<bool>> gone;
  ObservationReport report;
};

/// `small`: volumes that are dissolved though their material is not their mothers'. `mixed`: the
/// daughters' volumes that are part of their mother's mixture, which is its material by now: they
/// disappear with all that is in them. The world has to be finished.
Dissolved dissolve(const World& world, const Marks& marks, const SmallVolumes& small = {},
                   const ChosenMixtures& mixed = {}, const DissolveOptions& options = {});

}  // namespace navjit
