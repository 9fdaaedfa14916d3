// Which volumes that nobody observes should be kept, for speed.
#pragma once

#include <set>
#include <utility>

#include "observe/budget.hpp"
#include "observe/marks.hpp"
#include "observe/passages.hpp"

namespace navjit {

/// Daughters and their mothers.
using Pairs = std::set<std::pair<VolumeId, VolumeId>>;

/// Whether nobody observes the boundary of the daughter in this mother, or the daughter is small
/// enough not to be missed.
inline bool nobody_sees(const Marks& marks, const SmallVolumes& small, VolumeId daughter,
                        VolumeId mother) {
  return invisible(marks, daughter, mother) || small.contains({daughter, mother});
}
/// Whether there is any daughter for which nobody_sees() is true.
bool anything_unseen(const World& world, const Marks& marks, const SmallVolumes& small);

/// Of the daughters for which nobody_sees() is true, those without which rays like these would take
/// longer. Dissolving a volume saves the steps that end on its boundary with its mother's own
/// material. But a spacer that touches the volumes on both sides has no such boundary, and a step
/// in the spacer becomes a step in the mother, which has to search all its daughters. And if
/// daughters fill an envelope, dissolving it makes the mother's search longer and saves nothing.
///
/// Steps are counted, and the time of a step is guessed from the number of daughters of the volume
/// in which it is made. `most_daughters`: as in DissolveOptions. Volumes that no ray passes are not
/// among the result.
Pairs better_kept(const World& world, const Marks& marks, const SmallVolumes& small,
                  const Passages& passages, std::size_t most_daughters);

}  // namespace navjit
