// How a scene finds the daughters that a ray or a point may meet.
#pragma once

#include <optional>

#include "analysis/scene_plan.hpp"

namespace navjit {

/// Fills in the plan's `candidates` and what they need; its classes have to be there. `forced`: the
/// search that the environment or a measurement asks for.
void choose_candidates(const Geometry& geometry, std::optional<Candidates> forced, ScenePlan& plan);

/// Whether the plan's cells have one daughter each, all of them with the same solid.
bool is_regular_grid(const ScenePlan& plan);

/// Fills in how the scene's safety is found.
void choose_safety(const Geometry& geometry, ScenePlan& plan);

}  // namespace navjit
