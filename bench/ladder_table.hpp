// The table of what each promise of a step costs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "geometry/navigation/geometry.hpp"
#include "navjit/runtime.hpp"
#include "runtime/transport.hpp"

namespace navjit::bench {

/// Prints cycles and, with `instructions`, instructions per step: of the floor, of every rung above
/// it, of the generic navigator behind the API, and of `specialised`, with what each adds to the
/// one before. Times of all are taken in turn, of one thread. Writes the same to `json`.
void print_ladder(const Geometry& geometry, Runtime& specialised, const std::vector<Ray>& rays,
                  bool instructions, nlohmann::ordered_json& json);

}  // namespace navjit::bench
