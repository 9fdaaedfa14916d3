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
  /// source on it is kept parsed, which needs the same `unit_name` for all of them. The code is the
  /// same.
  std::string preamble = {};
  /// Longer sources are refused: parsing cannot be interrupted, so this is what bounds it.
  std::size_t max_source_bytes = std::size_t{8} << 20;
  /// Processor time, ms: what takes longer is given up, at the pass or the function that it is at.
  double most_ms = std::numeric_limits<double>::infinity();
};

/// What one compilation cost (wall time, milliseconds) and made.
struct CompileReport {
  double frontend_ms = 0;      ///< Parsing, semantic analysis and generation of IR.
  double optimise_ms = 0;      ///< The IR pass pipeline.
  double codegen_ms = 0;       ///< Instruction selection to object bytes.
  bool kept_preamble = false;  ///< The source began with it, and it was parsed before.
  std::size_t code_bytes = 0;  ///< Machine code in the object, without constants and symbols.
};

/// A relocatable ELF object: holds no addresses, so it may be stored and linked in another process
/// on a machine that has the processor features it was compiled for.
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
/// One compilation at a time per `Compiler`; distinct objects may be used from distinct threads
/// concurrently. Moved-from objects may only be destroyed or assigned to.
class Compiler {
 public:
  /// Fails for an optimisation level out of range and for a processor or a feature that LLVM does
  /// not know.
  static Expected<Compiler> create(const CompileOptions& options);

  Compiler(Compiler&&) noexcept;
  Compiler& operator=(Compiler&&) noexcept;
  ~Compiler();

  /// Compiles `source`. `unit_name` stands for the file name in diagnostics and debug information.
  ///
  /// Fails, with the diagnostics and their line numbers in `source`, if the source is not valid,
  /// too long, has an expression of more than 32768 tokens, defines no function visible from
  /// outside, or needs initialisation at load time; also if `unit_name` begins with '-' or contains
  /// control characters. Source is trusted otherwise: it can be written to take any time.
  /// Errors are returned, never printed or thrown; only an internal error of LLVM ends the process.
  /// Runs on a thread of its own, so that neither the depth nor the size of the caller's stack
  /// matters; returns when it is done.
  ///
  /// Where memory or threads give out it fails as `exhausted`, and what was in the making is left
  /// behind, since LLVM cannot be taken down in the middle of its work: the `Compiler` may only be
  /// destroyed then.
  /// Once `stop` is requested it fails as `stopped` as soon as it can: after the parsing, or after
  /// the pass or the function that the code generator is at. It fails in the same way, not as
  /// `stopped`, once it has taken CompileOptions::most_ms.
  Expected<Object> compile(std::string_view source, std::string_view unit_name,
                           const std::stop_token& stop = {});

  /// Processor time that it has taken so far, s; those that are under way included. Thread-safe.
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

/// A line of text that differs whenever the same source could compile to different code: versions
/// of compiler and code generator, triple, processor, features, flags, optimisation level. Made to
/// be part of a cache key. Does not check that processor and features exist. Thread-safe.
std::string target_description(const CompileOptions& options);

/// False in a program that was linked without Clang and LLVM: every `Compiler` and `Linker` fails
/// to be made then.
bool has_compiler();

/// What the host's processor can do beside its architecture's baseline: LLVM's names of features,
/// sorted. Thread-safe.
std::vector<std::string> host_features();

}  // namespace navjit::jit
