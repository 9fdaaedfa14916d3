#include "runtime/version.hpp"

#include "jit/compiler.hpp"
#include "navjit/version.hpp"
#include "runtime/plugin_text.hpp"

namespace navjit {
namespace {

#if defined(__clang__)
constexpr const char* compiler = "Clang " __clang_version__;
#else
constexpr const char* compiler = "GCC " __VERSION__;
#endif

/// For instance "LLVM 19.1.7".
std::string code_generator() {
  if (!jit::has_compiler()) return "no LLVM";
  const std::string text = jit::target_description({});
  const std::string first = text.substr(0, text.find(';'));
  return "LLVM" + first.substr(first.find(' '));
}

}  // namespace

std::string version_line() {
  return std::string("navjit ") + version() + " (" + compiler + ", " + code_generator() +
         ", kernels " + std::string(generator_fingerprint()).substr(0, 12) + ")";
}

}  // namespace navjit
