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

/// Takes back every licence to deviate from strict floating point that pragmas and attributes in
/// the source gave: contraction, reassociation, disregard of NaN, infinity and the sign of zero.
void make_floating_point_strict(llvm::Module& module);

/// Runs the standard pipeline of passes for `level` (0 to 3) on `module`. Once its bound is reached
/// it passes over what is left to be done, and `module` is of no further use.
void optimise(llvm::Module& module, llvm::TargetMachine& machine, int level, const Bound& bound);

/// Generates a relocatable object; leaves `module` lowered and of no further use. Once its bound is
/// reached it leaves out the functions that it has not begun, and fails.
Expected<std::vector<char>> emit_object(llvm::Module& module, llvm::TargetMachine& machine,
                                        const Bound& bound);

/// Bytes of machine code in a relocatable object, zero if it cannot be read.
std::size_t machine_code_bytes(const std::vector<char>& object);

}  // namespace navjit::jit::detail
