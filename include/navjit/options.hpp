// How a Runtime is to work.
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

/// What generated code may use of the processor. A set that the processor lacks counts as native.
enum class InstructionSet : std::uint8_t {
  native,  ///< all that this processor has
  sse42,   ///< x86-64-v2
  avx2,    ///< x86-64-v3
  avx512,  ///< x86-64-v4
};

/// When a scene is worth compiling, and how. The reasons are in docs/decisions.md.
struct SpecialiserOptions {
  /// Time between looks at the profile: at least 0.1, at most an hour. Looks become rarer in long
  /// runs and while nothing is navigated, up to a second apart for the default.
  double poll_ms = 5;
  /// How much a ms of the compiler's thread counts beside one of navigation: little, as runs are
  /// long. A thirtieth counts while fewer threads of the process are busy than it has processors.
  double compile_weight = 0.3;
  /// Compile code for the hottest scenes. If this, `structures` and `solids` are all false, nothing
  /// is compiled: scenes are bound to data alone.
  bool constants = true;
  /// Compile navigators for structures that the library has no instance for, before constants.
  bool structures = true;
  /// Compile code for hot solids that are made of several others, for all scenes that hold them and
  /// are bound to data.
  bool solids = true;
  std::uint64_t min_steps = 2000;  ///< fewer steps in a scene tell nothing
  std::size_t batch = 24;          ///< scenes in one module at the most
  double module_ms = 900;  ///< the expected time for a module at the most, so that the first scenes
                           ///< need not wait for the last
  /// Compiling stops once it has taken `compile_first_ms` and also this share of the run's time:
  /// the hottest scenes come first, and what is left gains little. Not for JitMode::wait.
  double compile_first_ms = 2500;
  double compile_share = 0.15;
  /// The longest that JitMode::wait compiles, expected or measured. What occurs most often in the
  /// detector comes first, and the rest is bound to data alone.
  double wait_ms = 6000;
  double half_life_s = 2;  ///< of the execution counts that decide what is compiled first
  int nice = 0;            ///< priority of the thread that compiles, as of nice(1); 0 to 19
  int optimisation = 2;    ///< of the compiler
  InstructionSet instruction_set = InstructionSet::native;
  double recheck_ms = 1000;      ///< between checks of what is installed; longer in long runs
  bool keep_only_faster = true;  ///< install only what is measured to be no slower
  bool safety = true;            ///< specialise safeties, too; wasted if nobody asks for them
  bool perf_map = false;         ///< name generated functions for perf
  bool debug_info = false;       ///< line tables of generated code for gdb
};

/// All that a Runtime can be told.
struct RuntimeOptions {
  /// How far from the surface a step may end, mm. Every scene is checked against this, by a bound
  /// and by measurement; Runtime::final_report() says which pass. Nothing: none is checked.
  std::optional<double> budget{};
  JitMode jit = JitMode::on;
  Cache cache{};  ///< of compiled code; default: none. Relative paths are resolved at once
  /// A plugin to install before the first step, whatever `jit` says. With JitMode::on its scenes
  /// are on trial in the run from then on. If something is wrong with it, a warning goes to the
  /// log, and the run goes on without it.
  std::string plugin{};
  SpecialiserOptions specialiser{};
  /// Empty: the default logger of spdlog if the program has set one, else standard error.
  LogSink log{};
  GeometryOptions geometry{};
};

}  // namespace navjit
