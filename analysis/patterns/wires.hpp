// Wires: parallel tubes or bars side by side, in rows, at any angle to the mother's axes, in any
// order in the file: wire planes, layers of straws or of fibres.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "analysis/scene_plan.hpp"

namespace navjit {

/// The rows of wires that most daughters are in; nothing if too many are in none, or if rows would
/// tell little of where the wires are. `margin` (mm) is added around each wire. Pitches may vary,
/// wires may be missing, differ in length, and be off their row by less than their thickness.
std::optional<Wires> find_wires(const World& world, const Solid& mother,
                                std::span<const Daughter> daughters, double margin);

/// "2400 wires in 1 row", "96 wires in 4 rows and 3 more".
std::string describe_wires(const Wires& wires);

}  // namespace navjit
