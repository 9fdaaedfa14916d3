// One scene in, a plan for its navigator out.
#pragma once

#include "analysis/facts.hpp"

namespace navjit {

/// Always succeeds: a scene without structure gets a plan that tests every daughter.
ScenePlan plan_scene(const Geometry& geometry, const WorldFacts& facts, VolumeId volume);

/// Whether the plan's navigator is expected to beat the generic one; `why` says the reason.
bool worth_compiling(const Geometry& geometry, const ScenePlan& plan, std::string* why = nullptr);

/// The plan in lines of text for `navjit inspect`.
std::string describe(const Geometry& geometry, const ScenePlan& plan);

/// Kernels that cost so much more than a slab test that their box goes first.
bool is_costly(SolidKind kind);

}  // namespace navjit
