// The table of what each promise of a step costs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "geometry/navigation/geometry.hpp"
#include "navjit/runtime.hpp"
#include "runtime/transport.hpp"

namespace navjit::bench {

/// Prints cycles and, with `instructions`, instructions for each step: for the floor, every rung
/// above it, the generic navigator behind the API, and `specialised`, each with the difference to
/// the one before. All are timed in turn, on one thread. Writes the same to `json`.
void print_ladder(const Geometry& geometry, Runtime& specialised, const std::vector<Ray>& rays,
                  bool instructions, nlohmann::ordered_json& json);

}  // namespace navjit::bench
