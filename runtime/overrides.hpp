// Forces scenes to a search from outside, or to none, to bisect a problem in the field.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "analysis/facts.hpp"

namespace navjit {

struct Overrides {
  /// What each volume is forced to; nothing if it stays generic.
  std::map<VolumeId, std::optional<Candidates>> searches;
  std::string complaints;  ///< what was not understood and is left out, one line each
};

/// Parses "NAME=VARIANT,NAME=VARIANT": logical volumes by name ("*" for every one; later entries
/// override earlier ones). A variant is "off" or the name of a search (analysis/searches.hpp). A
/// scene that cannot have the search has `boxes`; instead of `tree` it has `all`.
Overrides parse_overrides(const World& world, std::string_view text);

/// The environment variable that a Runtime reads overrides from.
constexpr const char* overrides_variable = "NAVJIT_SCENES";

}  // namespace navjit
