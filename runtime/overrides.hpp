// Forcing scenes to a variant from outside, to bisect a problem in the field.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "analysis/facts.hpp"

namespace navjit {

enum class Variant : std::uint8_t {
  off,     ///< stays generic
  all,     ///< specialised, every daughter tested
  lanes,   ///< specialised, all daughters four at once; boxes where they are not a few boxes
  nest,    ///< specialised, candidates next in radius; boxes where that is no pattern
  rings,   ///< specialised, candidates by sectors; boxes where that is no pattern
  wires,   ///< bound to data, candidates next across, in rows; boxes where that is no pattern
  grid,    ///< specialised, candidates from cells
  boxes,   ///< specialised, candidates from cells and blocks of boxes
  scan,    ///< specialised, candidates from the boxes of all; boxes where there are too many
  groups,  ///< bound to data, the same by groups of eight; boxes where there are too many
  tree,    ///< bound to data, candidates from the hierarchy of boxes; all where there is none
  layers,  ///< bound to data, candidates by slabs within slabs; boxes where that is no pattern
};

/// The search that the variant forces; nothing for off.
std::optional<Candidates> candidates_of(Variant variant);

struct Overrides {
  std::map<VolumeId, Variant> variants;
  std::string complaints;  ///< what could not be understood and is left out, one line each
};

/// Parses "NAME=VARIANT,NAME=VARIANT": logical volumes by name ("*" for every one; later entries
/// override earlier ones), variants by the names above.
Overrides parse_overrides(const World& world, std::string_view text);

/// The environment variable that a Runtime reads overrides from.
constexpr const char* overrides_variable = "NAVJIT_SCENES";

}  // namespace navjit
