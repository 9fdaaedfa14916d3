// Code for single solids, which scenes that are bound to data call. Without it, a boolean of
// several solids is asked through a switch for each operand. The code of one solid serves all
// scenes that have the solid, and costs a fraction of what compiling each of these scenes would.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "codegen/data/arena.hpp"
#include "geometry/solids/solid.hpp"

namespace navjit::codegen {

/// The functions of one solid in a module (kernels::SolidCode), which are extern "C" symbols.
struct SolidEntry {
  std::string contains, distance_to_in, distance_to_out;
  std::string safety_to_in, safety_to_out;  ///< empty if there is no code for the safety
  const void* data = nullptr;  ///< the functions' `data`: numbers that are not constants
};

struct SolidModule {
  std::string source;
  std::vector<SolidEntry> entries;     ///< in the order of the solids
  std::shared_ptr<const Arena> owner;  ///< of the data
};

/// Whether the solid is made of several, so that code for it has fewer branches than the library's.
bool gains_from_code(const kernels::AnySolid<double>& solid);

/// What the code of a solid consists of, which determines the cost of compiling it. Types that
/// occur again share their functions.
struct SolidTypes {
  std::size_t composed = 0;  ///< different types of booleans in it, including itself
  std::size_t plain = 0;     ///< different kinds of solids, except boxes
};
SolidTypes types_in(const kernels::AnySolid<double>& solid);

/// Generates the code of these solids. `tolerance` (mm) is a constant in the code. `with_safety`:
/// includes the safeties.
SolidModule generate_solids(std::span<const kernels::AnySolid<double>> solids, double tolerance,
                            bool with_safety);

}  // namespace navjit::codegen
