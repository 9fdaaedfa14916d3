// Wires: parallel tubes or bars side by side in rows, at any angle to the mother's axes and in any
// order in the file, such as wire planes and layers of straws or fibres.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "analysis/scene_plan.hpp"

namespace navjit {

/// The rows of wires that contain most daughters; nothing if too many are in no row, or if rows
/// would hardly tell where the wires are. `margin` (mm) is added around each wire. Pitches may
/// vary. Wires may be missing, differ in length, and be off their row by less than their thickness.
std::optional<Wires> find_wires(const World& world, const Solid& mother,
                                std::span<const Daughter> daughters, double margin);

/// "2400 wires in 1 row", "96 wires in 4 rows and 3 more".
std::string describe_wires(const Wires& wires);

}  // namespace navjit
