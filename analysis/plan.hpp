// Makes the plan for a scene's navigator.
#pragma once

#include <string_view>

#include "analysis/facts.hpp"

namespace navjit {

/// Always succeeds: the plan of a scene without structure tests every daughter.
ScenePlan plan_scene(const Geometry& geometry, const WorldFacts& facts, VolumeId volume);

/// Whether a navigator is worth compiling, and why or why not, for people.
struct Worth {
  bool compiling = false;
  std::string_view why;  ///< a literal

  explicit operator bool() const { return compiling; }
};

/// Whether the plan's navigator is expected to beat the generic one.
Worth worth_compiling(const Geometry& geometry, const ScenePlan& plan);

/// How many numbers the scene's solids consist of, each solid of a class once.
std::size_t numbers_of_solids(const Geometry& geometry, const ScenePlan& plan);

/// The plan in lines of text for `navjit inspect`.
std::string describe(const Geometry& geometry, const ScenePlan& plan);

/// Whether the kernel of this kind costs so much more than a test of its box that the box is tested
/// first.
bool is_costly(SolidKind kind);

}  // namespace navjit
