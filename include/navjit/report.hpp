// What a run was like.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "navjit/detail/api.hpp"

namespace NAVJIT_API navjit {

/// What became of the attempt to compile code for a scene.
enum class SceneStatus : std::uint8_t {
  generic,  ///< not hot enough, or the JIT is off
  compiling,
  specialised,
  unprofitable,  ///< analysed or measured: no gain
  failed,        ///< did not compile, link or verify
};

/// What navigates a scene: the generic navigator, or the scene template with its numbers bound to
/// data (compiled with the library), to a structure (compiled in this run for all scenes that have
/// it, the numbers being data) or to constants (compiled in this run, or for it).
enum class Binding : std::uint8_t { generic, data, structure, constants };

/// As reports have it.
const char* binding_name(Binding binding);

/// As reports have it.
const char* status_name(SceneStatus status);

/// Where a scene's code came from.
enum class CodeOrigin : std::uint8_t { none, compiler, cache, plugin };

/// As reports have it; empty for none.
const char* origin_name(CodeOrigin origin);

/// A scene held to the error that RuntimeOptions::budget allows; lengths in mm.
struct BudgetReport {
  bool met = false;        ///< promised: the bound and the error measured are both within it
  double bound_mm = 0;     ///< infinite where none is known
  double measured_mm = 0;  ///< the largest on recorded states, against 113 bits
  std::size_t states = 0;  ///< so many
  std::string why;
};

/// One scene; times are 0 where not measured.
struct SceneReport {
  std::uint32_t volume_id = 0;
  std::string volume{};
  std::string structure{};  ///< how it is searched, in words: "70 slabs along z"; of final_report()
  std::uint64_t steps = 0;
  double share = 0;  ///< of all steps
  /// About how often a point was located in it: at the end of steps that were made elsewhere, or
  /// because the caller asked where a point is, with a direction. Estimated from samples; 0 without
  /// the JIT.
  std::uint64_t relocations = 0;
  /// Processor time on the recorded states, replayed.
  double generic_ns_per_step = 0;
  double specialised_ns_per_step = 0;
  double compile_ms = 0;  ///< this scene's part of its module
  /// When it came to be specialised, in whatever way, and was it ever since; 0 if it is not. Since
  /// the runtime was made.
  double specialised_at_s = 0;
  double swapped_at_s = 0;                    ///< when its present navigator was installed
  SceneStatus status = SceneStatus::generic;  ///< of its own code, compiled for it
  Binding binding = Binding::generic;
  CodeOrigin origin = CodeOrigin::none;
  /// Bound to data: solids of the scene that have code of their own, which its navigator calls.
  std::size_t compiled_solids = 0;
  std::string note{};                    ///< why it failed or does not pay
  std::optional<BudgetReport> budget{};  ///< of final_report() alone, where one is asked for
};

/// A run so far. Times are s unless the name says otherwise.
struct RuntimeReport {
  double seconds = 0;  ///< since the runtime was made
  std::uint64_t steps = 0;
  /// By steps, then by relocations, most first. Scenes without a step are left out, unless the
  /// program locates more points than it makes steps; then those without relocations are.
  std::vector<SceneReport> scenes;
  std::size_t modules = 0;         ///< compiled, or taken from the cache
  std::size_t cached_modules = 0;  ///< those that were taken from the cache
  double compile_ms = 0;           ///< all modules, link and verification
  std::size_t code_bytes = 0;
  std::size_t waiting_to_be_freed = 0;
  std::size_t plugin_scenes = 0;  ///< installed from the plugin
  std::size_t deoptimised = 0;    ///< scenes that were specialised and are generic again
};

}  // namespace navjit
