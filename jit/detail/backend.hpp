#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "jit/detail/bound.hpp"
#include "navjit/detail/expected.hpp"

namespace llvm {
class Module;
class TargetMachine;
}  // namespace llvm

namespace navjit::jit::detail {

/// Removes all deviations from strict floating point that pragmas and attributes in the source
/// allowed: contraction, reassociation, and disregard of NaN, infinity and the sign of zero.
void make_floating_point_strict(llvm::Module& module);

/// Runs the standard pipeline of passes for `level` (0 to 3) on `module`. Once the bound is
/// reached, the remaining passes are skipped, and `module` must not be used any more.
void optimise(llvm::Module& module, llvm::TargetMachine& machine, int level, const Bound& bound);

/// Generates a relocatable object. Afterwards `module` is lowered and must not be used any more.
/// Once the bound is reached, functions that have not been begun are left out, and the call fails.
Expected<std::vector<char>> emit_object(llvm::Module& module, llvm::TargetMachine& machine,
                                        const Bound& bound);

/// Bytes of machine code in a relocatable object, zero if it cannot be read.
std::size_t machine_code_bytes(const std::vector<char>& object);

}  // namespace navjit::jit::detail
