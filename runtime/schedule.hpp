// What is worth compiling, and what first: the cost model. docs/decisions.md has the reasons and
// the measurements behind the constants.
#pragma once

#include <span>
#include <vector>

#include "analysis/plan.hpp"
#include "navjit/options.hpp"

namespace navjit {

/// Expected time to compile a scene beside others in a module, ms, on the machine that the model
/// was fitted on.
double expected_compile_ms(const Geometry& geometry, const ScenePlan& plan);

/// The same for the code of a solid alone.
double expected_compile_ms(const kernels::AnySolid<double>& solid);

/// What any module costs beside its scenes, ms: reading the kernels.
constexpr double module_base_ms = 30;

/// The time that a module may be expected to take, ms, in a run that has lasted `seconds`. A run
/// may be expected to go on for as long again, and nothing is won until the code is there.
double most_module_ms(double seconds, const SpecialiserOptions& options);

/// A scene that is expected to take longer by itself is not compiled: all others would wait for it,
/// and no module is to take more than a second. One scene in ten takes 1.3 times what is expected,
/// or more.
constexpr double most_scene_ms = 750;

/// Expected gain of a step or relocation, ns.
double expected_gain_ns(const ScenePlan& plan);

/// The weight of a ms of the compiler's thread (SpecialiserOptions::compile_weight) while this many
/// threads of the process are busy beside it on average: less where a processor is left for it.
double weight_of_compiling(double weight, double busy_threads, unsigned processors);

/// A scene that might be compiled.
struct Candidate {
  VolumeId volume = 0;
  double executions = 0;  ///< steps and relocations in it so far
  double recent = 0;      ///< the same, but older ones fade away
  double compile_ms = 0, gain_ns = 0;
};

/// How many times what was spent in the scene so far has paid for compiling it.
double times_paid(const Candidate& candidate, const SpecialiserOptions& options);

/// Has it paid once, or at least the given part of that?
bool is_due(const Candidate& candidate, const SpecialiserOptions& options, double part = 1);

/// The scenes of the next module; none unless one is due. What pays back soonest comes first;
/// scenes that are about to be due go along. Scenes that have paid fewer than `least` times go
/// along only as long as the module is small, because something of another kind is due before them.
/// Bounded by SpecialiserOptions::batch and module_ms; a scene that exceeds the latter comes alone,
/// before others if it wins more for what it costs.
std::vector<VolumeId> next_module(std::span<const Candidate> candidates,
                                  const SpecialiserOptions& options, double least = 0);

}  // namespace navjit
