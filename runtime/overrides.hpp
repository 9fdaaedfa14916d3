// Forces scenes to a variant from outside, to bisect a problem in the field.
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
  lanes,   ///< specialised, all daughters tested four at once; `boxes` unless they are a few boxes
  nest,    ///< specialised, daughters looked up by shells; `boxes` if they are not a nest
  rings,   ///< specialised, daughters looked up by sectors; `boxes` if they are not in rings
  wires,   ///< bound to data, daughters looked up in rows; `boxes` if they are not wires
  grid,    ///< specialised, daughters found by cells
  boxes,   ///< specialised, daughters found by cells and blocks of boxes
  scan,    ///< specialised, daughters found by the boxes of all; `boxes` if there are too many
  groups,  ///< bound to data, the same by groups of eight; `boxes` if there are too many
  tree,    ///< bound to data, by the hierarchy of boxes; `all` if there is none
  layers,  ///< bound to data, slabs within slabs; `boxes` if they are not in layers
};

/// The search that the variant forces; nothing for `off`.
std::optional<Candidates> candidates_of(Variant variant);

struct Overrides {
  std::map<VolumeId, Variant> variants;
  std::string complaints;  ///< what was not understood and is left out, one line each
};

/// Parses "NAME=VARIANT,NAME=VARIANT": logical volumes by name ("*" for every one; later entries
/// override earlier ones), variants by the names above.
Overrides parse_overrides(const World& world, std::string_view text);

/// The environment variable that a Runtime reads overrides from.
constexpr const char* overrides_variable = "NAVJIT_SCENES";

}  // namespace navjit
