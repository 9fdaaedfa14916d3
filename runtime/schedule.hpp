// The cost model: what is worth compiling, and in what order. docs/decisions.md gives the reasons
// and the measurements behind the constants.
#pragma once

#include <span>
#include <vector>

#include "analysis/plan.hpp"
#include "navjit/options.hpp"

namespace navjit {

/// Expected time to compile a scene together with others in a module, ms, on the machine for which
/// the model was fitted.
double expected_compile_ms(const Geometry& geometry, const ScenePlan& plan);

/// The same for the code of a solid alone.
double expected_compile_ms(const kernels::AnySolid<double>& solid);

/// The cost of any module besides its scenes, ms: reading the kernels.
constexpr double module_base_ms = 30;

/// The longest time that a module may be expected to take, ms, in a run that has lasted `seconds`.
/// A run can be expected to go on for as long again, and nothing is gained until the code is there.
double most_module_ms(double seconds, const SpecialiserOptions& options);

/// A scene that is expected to take longer than this alone is not compiled: all others would wait
/// for it, and no module should take more than a second. One scene in ten takes 1.3 times the
/// expected time or more.
constexpr double most_scene_ms = 750;

/// Expected gain of a step or relocation, ns.
double expected_gain_ns(const ScenePlan& plan);

/// The weight of a ms of the compiler's thread (SpecialiserOptions::compile_weight) while on
/// average this many other threads of the process are busy. It is smaller if a processor is left
/// for the compiler.
double weight_of_compiling(double weight, double busy_threads, unsigned processors);

/// A scene that might be compiled.
struct Candidate {
  VolumeId volume = 0;
  double executions = 0;  ///< steps and relocations in it so far
  double recent = 0;      ///< the same, with older executions fading away
  double compile_ms = 0, gain_ns = 0;
};

/// How many times the time spent in the scene so far has paid for compiling it.
double times_paid(const Candidate& candidate, const SpecialiserOptions& options);

/// Has the scene paid once for compiling it, or at least the given part of that?
bool is_due(const Candidate& candidate, const SpecialiserOptions& options, double part = 1);

/// The scenes of the next module; none unless one is due. The scene that pays back soonest comes
/// first, and scenes that are nearly due are included. Scenes that have paid fewer than `least`
/// times are included only as long as the module is small, because something of another kind is due
/// before them. The module is bounded by SpecialiserOptions::batch and module_ms. A scene that
/// exceeds the latter is compiled alone, before others if it gains more for its cost.
std::vector<VolumeId> next_module(std::span<const Candidate> candidates,
                                  const SpecialiserOptions& options, double least = 0);

}  // namespace navjit
