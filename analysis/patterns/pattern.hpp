// Names regular arrangements of daughters.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "geometry/navigation/geometry.hpp"

namespace navjit {

/// How daughters are arranged along the axes, by the middles of their boxes.
enum class Arrangement : std::uint8_t { leaf, single, slabs, grid, nest, other };

struct Pattern {
  Arrangement arrangement = Arrangement::leaf;  ///< what navigation may depend on
  /// What a reader would call it: "leaf", "single", "70 slabs along z", "grid 4 x 4 x 1", or "N
  /// daughters". For display.
  std::string words;
};
Pattern pattern_of(std::span<const Extent> boxes);

/// The arrangement about an axis or the centre, for instance "nest of 6 shells about z", "ring of
/// 24 about z", "ring of 22 of 24 about z and 3 more" or "13 rings of 5 about x"; empty if most
/// daughters are in none.
std::string describe_round_pattern(const World& world, const Solid& mother,
                                   std::span<const Daughter> daughters, double margin);

}  // namespace navjit
