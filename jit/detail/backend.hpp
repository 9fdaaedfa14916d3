#pragma once

#include <cstddef>
#include <stop_token>
#include <string>
#include <vector>

#include "navjit/detail/expected.hpp"

namespace llvm {
class Module;
class TargetMachine;
}  // namespace llvm

namespace navjit::jit::detail {

/// Takes back every licence to deviate from strict floating point that pragmas and attributes in
/// the source gave: contraction, reassociation, disregard of NaN, infinity and the sign of zero.
void make_floating_point_strict(llvm::Module& module);

/// Runs the standard pipeline of passes for `level` (0 to 3) on `module`. Once asked to stop it
/// passes over what is left to be done, and `module` is of no further use.
void optimise(llvm::Module& module, llvm::TargetMachine& machine, int level,
              const std::stop_token& stop);

/// Generates a relocatable object; leaves `module` lowered and of no further use. Once asked to
/// stop it leaves out the functions that it has not begun, and fails.
Expected<std::vector<char>> emit_object(llvm::Module& module, llvm::TargetMachine& machine,
                                        const std::stop_token& stop);

/// Bytes of machine code in a relocatable object, zero if it cannot be read.
std::size_t machine_code_bytes(const std::vector<char>& object);

}  // namespace navjit::jit::detail
