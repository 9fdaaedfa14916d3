// Extruded solids with steps: two sections at one z, where one body ends and another one begins.
#pragma once

#include <span>
#include <vector>

#include "navjit/solids.hpp"

namespace navjit {

/// The sections of each body between such steps; a section that is there twice counts once. What
/// the sections describe is the union of the bodies.
inline std::vector<std::vector<ExtrudedSection>> bodies_between_steps(
    std::span<const ExtrudedSection> sections) {
  std::vector<std::vector<ExtrudedSection>> bodies(1);
  for (const ExtrudedSection& s : sections) {
    if (!bodies.back().empty() && bodies.back().back().z == s.z) {
      const ExtrudedSection& last = bodies.back().back();
      if (last.x == s.x && last.y == s.y && last.scale == s.scale) continue;
      bodies.emplace_back();
    }
    bodies.back().push_back(s);
  }
  return bodies;
}

}  // namespace navjit
