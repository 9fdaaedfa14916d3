// How a Runtime shall work.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "navjit/cache.hpp"
#include "navjit/detail/api.hpp"
#include "navjit/log.hpp"
#include "navjit/search.hpp"

namespace NAVJIT_API navjit {

/// Whether and when scenes get navigators of their own.
enum class JitMode : std::uint8_t {
  off,     ///< generic navigators only; scenes are still profiled
  on,      ///< hot scenes are specialised in the background
  wait,    ///< every scene is specialised before the Runtime's constructor returns
  shadow,  ///< as `on`, and every step is also made generically and compared
};

/// What generated code may use of the processor. One that the processor lacks is taken as native.
enum class InstructionSet : std::uint8_t {
  native,  ///< all that this processor has
  sse42,   ///< x86-64-v2
  avx2,    ///< x86-64-v3
  avx512,  ///< x86-64-v4
};

/// When a scene is worth compiling, and how. Reasons in docs/decisions.md.
struct SpecialiserOptions {
  /// Between looks at the profile: at least 0.1, at most an hour. In long runs they become rarer,
  /// and while nothing is navigated, a second at the most for the default.
  double poll_ms = 5;
  /// What a ms of the compiler's thread counts beside one of navigation. Little: runs go on for
  /// long. A thirtieth counts while fewer threads of the process are busy than it has processors.
  double compile_weight = 0.3;
  /// Compile code for the hottest scenes. Without it, `structures` and `solids` nothing is
  /// compiled: scenes are bound to data alone.
  bool constants = true;
  /// Compile navigators for structures that the library has no instance for, before constants.
  bool structures = true;
  /// Compile code for hot solids that are made of several, for all scenes that hold them and are
  /// bound to data.
  bool solids = true;
  std::uint64_t min_steps = 2000;  ///< fewer steps in a scene tell nothing
  std::size_t batch = 24;          ///< scenes in one module at the most
  double module_ms = 900;  ///< expected time for a module at the most: the first scenes need
                           ///< not wait for the last
  /// Compiling stops once it has taken `compile_first_ms` and this share of the run's time beside:
  /// the hottest scenes came first, and what is left wins little. Not for JitMode::wait.
  double compile_first_ms = 2500;
  double compile_share = 0.15;
  /// The most that JitMode::wait compiles for, expected or measured. What occurs most often in the
  /// detector comes first, and the rest is bound to data alone.
  double wait_ms = 6000;
  double half_life_s = 2;  ///< of the execution counts that decide what is compiled first
  int nice = 0;            ///< priority of the thread that compiles, as of nice(1); 0 to 19
  int optimisation = 2;    ///< of the compiler
  InstructionSet instruction_set = InstructionSet::native;
  double recheck_ms = 1000;      ///< between checks of what is installed; in long runs rarer, too
  bool keep_only_faster = true;  ///< install only what is measured to be no slower
  bool safety = true;            ///< specialise it, too; wasted where nobody asks for it
  bool perf_map = false;         ///< name generated functions for perf
  bool debug_info = false;       ///< line tables of generated code for gdb
};

/// All that a Runtime can be told.
struct RuntimeOptions {
  /// How far from the surface a step may end, mm. Every scene is held to it, by a bound and by
  /// measurement; Runtime::final_report() says which keep it. Nothing: none are.
  std::optional<double> budget{};
  JitMode jit = JitMode::on;
  Cache cache{};  ///< of compiled code; none unless asked for. A relative path is taken at once
  /// Installed before the first step, whatever `jit` says; what is wrong with it is a warning in
  /// the log, and the run goes on without it.
  std::string plugin{};
  SpecialiserOptions specialiser{};
  /// Empty: the program's default logger of spdlog where it has set one, else standard error.
  LogSink log{};
  GeometryOptions geometry{};
};

}  // namespace navjit
