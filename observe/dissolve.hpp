// Rewrites the tree: daughters that nobody observes give their own daughters to their mothers.
#pragma once

#include <string>
#include <vector>

#include "observe/budget.hpp"
#include "observe/choose_mixtures.hpp"
#include "observe/marks.hpp"
#include "observe/worth_dissolving.hpp"

namespace navjit {

/// When it pays to dissolve a volume.
struct DissolveOptions {
  /// A volume with more daughters than this helps to find them, and is kept, unless it is all that
  /// its mother contains.
  std::size_t most_daughters = 3;
  /// Daughters of these mothers that are kept for speed.
  Pairs kept{};
};

/// The world without the volumes that nobody observes.
struct Dissolved {
  World world;  ///< finished; volumes have their numbers
  /// For each daughter of each volume: the number of its touchable in the original world, minus
  /// that of the mother's.
  std::vector<std::vector<TouchableId>> offsets;
  /// For each daughter of each volume of the original world: whether it is missing from the tree.
  std::vector<std::vector<bool>> gone;
  ObservationReport report;
};

/// `small` are volumes that are dissolved although their material is not their mothers'. `mixed`
/// are the volumes of daughters that are part of their mother's mixture, which already is the
/// mother's material. These disappear with all that is in them. The world must be finished.
Dissolved dissolve(const World& world, const Marks& marks, const SmallVolumes& small = {},
                   const ChosenMixtures& mixed = {}, const DissolveOptions& options = {});

}  // namespace navjit
