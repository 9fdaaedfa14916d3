// Which volumes that nobody sees are better left where they are, for speed.
#pragma once

#include <set>
#include <utility>

#include "observe/budget.hpp"
#include "observe/marks.hpp"
#include "observe/passages.hpp"

namespace navjit {

/// Daughters and their mothers.
using Pairs = std::set<std::pair<VolumeId, VolumeId>>;

/// Whether nobody sees the daughter in this mother, or it is small enough not to be missed.
inline bool nobody_sees(const Marks& marks, const SmallVolumes& small, VolumeId daughter,
                        VolumeId mother) {
  return invisible(marks, daughter, mother) || small.contains({daughter, mother});
}
/// Whether there is any daughter that nobody sees.
bool anything_unseen(const World& world, const Marks& marks, const SmallVolumes& small);

/// Of the daughters that nobody sees, those without which rays like these would take longer. A
/// dissolved volume spares the steps that end on its boundary with its mother's own material. But a
/// spacer that touches what is on either side of it has no such boundary, and a step in it becomes
/// one in the mother, which has all its daughters to look at. And the daughters of an envelope that
/// they fill make the mother's search longer, and spare nothing.
///
/// Steps are counted, and what one takes is guessed from the number of daughters of the volume that
/// it is in. `most_daughters`: as DissolveOptions. Volumes that no ray passes are none of these.
Pairs better_kept(const World& world, const Marks& marks, const SmallVolumes& small,
                  const Passages& passages, std::size_t most_daughters);

}  // namespace navjit
