#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "navjit/detail/expected.hpp"

namespace navjit::jit {

/// What machine to compile for, and how hard to try.
struct CompileOptions {
  /// Optimisation level, 0 to 3. The loop vectoriser runs from 2 on.
  int optimisation = 2;
  /// Processor name as LLVM spells it ("x86-64-v3", "znver4"). Empty: the host's processor, with
  /// exactly the features the host reports.
  std::string cpu = {};
  /// Changes to the features `cpu` implies, each "+name" or "-name", applied in order.
  std::vector<std::string> features = {};
  /// Emit DWARF line tables, types and variables and keep frame pointers, so that a debugger shows
  /// source lines. The debugger finds the source if `unit_name` is the path of a file holding it.
  bool debug_info = false;
  /// Whole declarations, to the end of a line, with which sources may begin. From the second such
  /// source on the preamble is kept parsed, if all these sources have the same `unit_name`. The
  /// code is the same.
  std::string preamble = {};
  /// Longer sources are refused. Parsing cannot be interrupted, so its time can only be bounded in
  /// this way.
  std::size_t max_source_bytes = std::size_t{8} << 20;
  /// Processor time, ms. A compilation that takes longer is given up after the current pass or
  /// function.
  double most_ms = std::numeric_limits<double>::infinity();
};

/// What one compilation cost (wall time, milliseconds) and made.
struct CompileReport {
  double frontend_ms = 0;      ///< Parsing, semantic analysis and generation of IR.
  double optimise_ms = 0;      ///< The IR pass pipeline.
  double codegen_ms = 0;       ///< Instruction selection to object bytes.
  bool kept_preamble = false;  ///< The source began with the preamble, which was already parsed.
  std::size_t code_bytes = 0;  ///< Machine code in the object, without constants and symbols.
};

/// A relocatable ELF object. It holds no addresses, so it may be stored, and linked in another
/// process on a machine that has the processor features for which it was compiled.
struct Object {
  std::vector<char> bytes;
  CompileReport report;
  std::string warnings;  ///< Compiler warnings, empty if there were none.
};

/// Compiles header-free C++20 to relocatable objects, in process.
///
/// Floating-point semantics are strict: no contraction to fused multiply-add (the explicit
/// `__builtin_fma` stays available), no reassociation, no assumptions about NaN or infinity;
/// `errno` is not set by mathematical functions. There are no exceptions, no RTTI and no
/// `#include`. Globals must be initialised by constants. Functions to be looked up after linking
/// are best declared `extern "C"`.
///
/// A `Compiler` does one compilation at a time. Different ones may be used by different threads at
/// the same time. A `Compiler` that was moved from may only be destroyed or assigned to.
class Compiler {
 public:
  /// Fails for an optimisation level that is out of range, and for a processor or a feature that
  /// LLVM does not know.
  static Expected<Compiler> create(const CompileOptions& options);

  Compiler(Compiler&&) noexcept;
  Compiler& operator=(Compiler&&) noexcept;
  ~Compiler();

  /// Compiles `source`. `unit_name` stands for the file name in diagnostics and debug information.
  ///
  /// Fails, with the diagnostics and their line numbers in `source`, if the source is not valid,
  /// too long, has an expression of more than 32768 tokens, defines no function visible from
  /// outside, or needs initialisation at load time; also if `unit_name` begins with '-' or contains
  /// control characters. For the rest, the source is trusted; it can be written to take any time.
  /// Errors are returned, never printed or thrown; only an internal error of LLVM ends the process.
  /// Runs on a thread of its own, so that neither the depth nor the size of the caller's stack
  /// matters; returns when it is done.
  ///
  /// If memory or threads run out, it fails as `exhausted`, and the state of the compilation is
  /// never freed, since LLVM cannot be taken down in the middle of its work. The `Compiler` may
  /// then only be destroyed.
  /// Once `stop` is requested it fails as `stopped` as soon as it can: after parsing, or after the
  /// current pass or the current function of the code generator. Once it has taken
  /// CompileOptions::most_ms it fails in the same way, but not as `stopped`.
  Expected<Object> compile(std::string_view source, std::string_view unit_name,
                           const std::stop_token& stop = {});

  /// The processor time of all compilations so far, s, including one that is under way.
  /// Thread-safe.
  double processor_seconds() const;

  /// Everything but the source that determines the code: see the function of the same name.
  const std::string& target_description() const;

 private:
  struct Impl;
  explicit Compiler(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Compiles once with a temporary `Compiler`. Thread-safe.
Expected<Object> compile(std::string_view source, std::string_view unit_name,
                         const CompileOptions& options);

/// A line of text that differs whenever the same source could compile to different code. It has the
/// versions of compiler and code generator, triple, processor, features, flags and optimisation
/// level, and is made to be part of a cache key. Does not check that processor and features exist.
/// Thread-safe.
std::string target_description(const CompileOptions& options);

/// False in a program that was linked without Clang and LLVM. In such a program, creating a
/// `Compiler` or a `Linker` always fails.
bool has_compiler();

/// LLVM's names of the features that the host's processor has beyond its architecture's baseline,
/// sorted. Thread-safe.
std::vector<std::string> host_features();

}  // namespace navjit::jit
