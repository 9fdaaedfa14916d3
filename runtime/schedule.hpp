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

/// No scene is compiled that is expected to take longer by itself: all others would wait for it.
constexpr double most_scene_ms = 1000;

/// Expected gain of a step or relocation, ns.
double expected_gain_ns(const ScenePlan& plan);

/// What a ms of the compiler's thread counts (SpecialiserOptions::compile_weight) where so many
/// threads of the process are busy beside it, on average: where a processor is left for it, less.
double weight_of_compiling(double weight, double busy_threads, unsigned processors);

/// A scene that might be compiled.
struct Candidate {
  VolumeId volume = 0;
  double executions = 0;  ///< steps and relocations in it so far
  double recent = 0;      ///< the same of late: what is gone by fades
  double compile_ms = 0, gain_ns = 0;
};

/// Has what was spent in the scene so far paid for compiling it, or at least the given part of
/// that?
bool is_due(const Candidate& candidate, const SpecialiserOptions& options, double part = 1);

/// The scenes of the next module; none unless one is due. What pays back soonest comes first;
/// scenes that are about to be due go along. Bounded by SpecialiserOptions::batch and module_ms;
/// one scene may exceed the latter.
std::vector<VolumeId> next_module(std::span<const Candidate> candidates,
                                  const SpecialiserOptions& options);

}  // namespace navjit
