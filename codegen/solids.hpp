// Code for solids alone, which scenes that are bound to data call: otherwise booleans of several
// solids are asked through a switch for each of their operands. One solid serves all scenes that
// have it, and costs a fraction of what compiling each of these would.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "codegen/data/arena.hpp"
#include "geometry/solids/solid.hpp"

namespace navjit::codegen {

/// The functions of one solid in a module (kernels::SolidCode); extern "C" symbols.
struct SolidEntry {
  std::string contains, distance_to_in, distance_to_out;
  std::string safety_to_in, safety_to_out;  ///< empty where safety has no code
  const void* data = nullptr;  ///< what they are handed: numbers that are not constants
};

struct SolidModule {
  std::string source;
  std::vector<SolidEntry> entries;     ///< in the order of the solids
  std::shared_ptr<const Arena> owner;  ///< of the data
};

/// Whether the solid is made of several, so that code for it has fewer branches than the library's.
bool gains_from_code(const kernels::AnySolid<double>& solid);

/// What the code of a solid is made of, which is what it costs to compile: types that occur again
/// share their functions.
struct SolidTypes {
  std::size_t composed = 0;  ///< different types of booleans in it, itself among them
  std::size_t plain = 0;     ///< different kinds of solids, but for boxes
};
SolidTypes types_in(const kernels::AnySolid<double>& solid);

/// Generates the code of these solids. `tolerance` is a constant in it, mm.
SolidModule generate_solids(std::span<const kernels::AnySolid<double>> solids, double tolerance,
                            bool with_safety);

}  // namespace navjit::codegen
