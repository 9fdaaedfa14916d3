#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "jit/compiler.hpp"
#include "jit/detail/preamble.hpp"
#include "jit/detail/target.hpp"
#include "navjit/detail/expected.hpp"

namespace llvm {
class LLVMContext;
class Module;
}  // namespace llvm

namespace navjit::jit::detail {

/// The result of parsing: a module in `context`, and the text of any warnings.
struct ParsedUnit {
  std::shared_ptr<llvm::Module> module;
  std::string warnings;
  bool kept_preamble = false;
};

/// Flags of the compiler proper that do not depend on the target: the dialect, the semantics of
/// floating point, and what `options` says.
std::vector<std::string> frontend_flags(const CompileOptions& options);

/// Parses `source` to unoptimised IR, or only its rest if it begins with the preamble. Fails with
/// the diagnostics if there are errors. The result must be destroyed before `context`.
Expected<ParsedUnit> parse(std::string_view source, std::string_view unit_name,
                           const std::vector<std::string>& flags, const Target& target,
                           Preamble& preamble, llvm::LLVMContext& context);

}  // namespace navjit::jit::detail
