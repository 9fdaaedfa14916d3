// The ways in which a scene finds the daughters that a ray or a point may meet, and what is known
// of each apart from its data (analysis/scene_plan.hpp) and its walk.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace navjit {

enum class Candidates : std::uint8_t {
  none,    ///< no daughters
  all,     ///< every daughter, one after the other
  lanes,   ///< every daughter, four at once; all are boxes along the axes
  slabs,   ///< the next ones along an axis
  nest,    ///< the next ones in radius
  rings,   ///< those in the sectors that the ray passes
  wires,   ///< the next ones across the wires, in rows
  grid,    ///< those in the cells that the ray passes
  boxes,   ///< the same, but only those whose boxes the ray meets
  scan,    ///< those whose boxes the ray meets; all boxes are tested first
  groups,  ///< the same, with boxes around several of them tested first
  tree,    ///< those that the generic navigator's hierarchy of boxes finds
  layers,  ///< those in the slabs within slabs that the ray passes
};

struct SearchFacts {
  Candidates search;
  /// For people, for NAVJIT_SCENES and in the lists of hot scenes that a cache keeps.
  std::string_view name;
  std::string_view of_daughters;     ///< what precedes the daughters in the name of a structure
  bool for_data_alone = false;       ///< no code is generated for it
  bool forced_from_outside = false;  ///< NAVJIT_SCENES knows it
  /// Whether a run may measure that it is faster than the search that the analysis chose. If so,
  /// the search is listed for the runs after it, whose code has it from the beginning.
  bool listed_if_faster = false;
};

/// In the order of the enumeration.
constexpr std::array<SearchFacts, 13> all_searches{{
    {.search = Candidates::none, .name = "none", .of_daughters = ""},
    {.search = Candidates::all,
     .name = "all",
     .of_daughters = "all of",
     .forced_from_outside = true},
    {.search = Candidates::lanes,
     .name = "lanes",
     .of_daughters = "lanes of",
     .forced_from_outside = true},
    {.search = Candidates::slabs,
     .name = "slabs",
     .of_daughters = "slabs of",
     .listed_if_faster = true},
    {.search = Candidates::nest,
     .name = "nest",
     .of_daughters = "nest of",
     .forced_from_outside = true},
    {.search = Candidates::rings,
     .name = "rings",
     .of_daughters = "rings of",
     .forced_from_outside = true,
     .listed_if_faster = true},
    {.search = Candidates::wires,
     .name = "wires",
     .of_daughters = "wires of",
     .for_data_alone = true,
     .forced_from_outside = true},
    {.search = Candidates::grid,
     .name = "grid",
     .of_daughters = "grid of",
     .forced_from_outside = true},
    {.search = Candidates::boxes,
     .name = "boxes",
     .of_daughters = "boxes around",
     .forced_from_outside = true},
    {.search = Candidates::scan,
     .name = "scan",
     .of_daughters = "scan of",
     .forced_from_outside = true,
     .listed_if_faster = true},
    {.search = Candidates::groups,
     .name = "groups",
     .of_daughters = "groups of",
     .for_data_alone = true,
     .forced_from_outside = true},
    {.search = Candidates::tree,
     .name = "tree",
     .of_daughters = "tree of",
     .for_data_alone = true,
     .forced_from_outside = true},
    {.search = Candidates::layers,
     .name = "layers",
     .of_daughters = "layers of",
     .for_data_alone = true,
     .forced_from_outside = true},
}};

/// Throws std::out_of_range for a search that is not in the table.
constexpr const SearchFacts& facts_of(Candidates search) {
  return all_searches.at(static_cast<std::size_t>(search));
}

static_assert([] {
  for (const SearchFacts& facts : all_searches) {
    if (&facts_of(facts.search) != &facts) return false;
  }
  return true;
}());

constexpr std::optional<Candidates> search_named(std::string_view name) {
  for (const SearchFacts& facts : all_searches) {
    if (facts.name == name) return facts.search;
  }
  return std::nullopt;
}

}  // namespace navjit
