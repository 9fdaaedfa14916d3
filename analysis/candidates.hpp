// How a scene finds the daughters that a ray or a point may meet.
#pragma once

#include <optional>

#include "analysis/scene_plan.hpp"

namespace navjit {

/// Fills in the plan's `candidates` and the data that they need; the plan must have its classes.
/// `forced` is the search that the environment or a measurement asks for.
void choose_candidates(const Geometry& geometry, std::optional<Candidates> forced, ScenePlan& plan);

/// Whether the plan's cells have one daughter each, all of them with the same solid.
bool is_regular_grid(const ScenePlan& plan);

/// Fills in the way in which the scene's safety is found.
void choose_safety(const Geometry& geometry, ScenePlan& plan);

}  // namespace navjit
