#pragma once

#include <memory>
#include <string>
#include <vector>

#include "jit/compiler.hpp"
#include "navjit/detail/expected.hpp"

namespace llvm {
class TargetMachine;
}

namespace navjit::jit::detail {

/// A target of which everything is known that depends on the host.
struct Target {
  std::string triple;
  std::string cpu;
  std::vector<std::string> features;  ///< Each "+name" or "-name"; later ones win.
};

/// Makes the code generator for this machine's architecture available. Idempotent, thread-safe.
void initialise_native_target();

/// Fills in what `options` leaves to the host. Does not validate.
Target resolve_target(const CompileOptions& options);

/// A code generator for `target`, without floating-point contraction. Fails if LLVM does not know
/// the processor or a feature. Only one thread at a time may use the result.
Expected<std::shared_ptr<llvm::TargetMachine>> make_target_machine(const Target& target,
                                                                   int optimisation);

}  // namespace navjit::jit::detail
