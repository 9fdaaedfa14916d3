// All that the specialiser knows and has, as plain data. What it does is written as functions on
// these data: gather, bind to data, choose, make modules, install, watch, report. Private to
// runtime/.
#pragma once

#include <algorithm>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <stop_token>

#include "analysis/facts.hpp"
#include "codegen/data/arena.hpp"
#include "codegen/data/code_of_solids.hpp"
#include "navjit/report.hpp"
#include "runtime/code_maker.hpp"
#include "runtime/composed_solids.hpp"
#include "runtime/group_trial.hpp"
#include "runtime/module_list.hpp"
#include "runtime/pace.hpp"
#include "runtime/schedule.hpp"
#include "runtime/shared.hpp"
#include "runtime/states.hpp"
#include "runtime/steady_seconds.hpp"
#include "runtime/trials.hpp"

namespace navjit {

/// If a navigator leaves more than one step in this many to the generic one, it is made again so
/// that it takes all of them. Leaving steps out made LHCb's code some 7% faster, and costs such a
/// step about twice its time. The share itself is a guess.
constexpr std::uint64_t bail_out_share = 8;

/// If a scene has fewer recorded states than this, most of its executions are relocations at the
/// end of steps made elsewhere. Replaying its own steps then says little, so only the run judges
/// it.
constexpr std::size_t few_recorded = 16;

/// Only the specialiser's thread uses this, except for what the mutex guards.
struct Specialisation {
  explicit Specialisation(std::shared_ptr<detail::Shared> runtime);

  bool stopping() const { return stop.stop_requested(); }
  /// The time since this was made, s.
  double seconds() const;
  /// Whether compiling has used all the time that it may take so far
  /// (SpecialiserOptions::compile_share).
  bool allowance_is_used_up() const;
  /// The number of steps in a volume and of relocations in it, each of which costs about as much as
  /// a step.
  double executions(VolumeId volume) const {
    return static_cast<double>(steps[volume]) + relocations[volume];
  }

  /// How many times longer than expected modules took, at least 1: the machine is another, or busy.
  double slower_than_expected() const {
    return expected_ms > 0 ? std::max(1.0, compiled_ms / expected_ms) : 1.0;
  }

  /// Processor time of the specialiser so far, s: that of its thread, which must be the caller, and
  /// that of the compiler, which has threads of its own.
  double own_seconds() const;

  /// Processor time of navigation, s, at the last look: all that is not the specialiser's.
  double navigated_s() const { return 1e-9 * navigating_ns - process_s_before; }

  /// SpecialiserOptions::poll_ms, kept within its limits.
  double poll_ms() const;

  /// SpecialiserOptions::compile_weight, or less if processors are free.
  double compile_weight() const;

  std::shared_ptr<detail::Shared> shared;
  WorldFacts facts;
  StateSampler sampler;
  std::shared_ptr<codegen::Arena> arena = std::make_shared<codegen::Arena>();  ///< bound data
  std::set<VolumeId> bound;  ///< volumes that need not, or must not, be bound to data (again)
  std::set<VolumeId> off;    ///< volumes that must not be specialised in any way
  /// Volumes whose search the environment forces; the first of equal ones.
  std::set<VolumeId> forced;
  std::vector<VolumeId> rare_due;   ///< scenes that are to be bound together
  std::uint64_t rare_again_at = 0;  ///< steps of the run before which no others are searched
  /// By volume: another entry that is bound to data, to be tried once the first was judged.
  std::map<VolumeId, const kernels::DispatchEntry*> second_choices;
  std::uint64_t structures_again_at = 0;  ///< steps of the run before which no structure pays
  std::map<VolumeId, cache::Digest> structures_of;  ///< digests of texts, of those looked at
  std::set<VolumeId> structure_tried;  ///< volumes whose structure was compiled, or need not be
  std::set<std::shared_ptr<const void>> structures;  ///< code of structures, with its tables
  std::optional<std::vector<ComposedSolid>> composed_solids{};  ///< set once they were searched
  codegen::CodeOfSolids code_of_solids;
  Trials trials;
  GroupTrial group;                    ///< scenes that are on trial together
  std::vector<VolumeId> group_judged;  ///< the compiled scenes when a group of them was last tried
  std::size_t all_judged = 0;       ///< how many scenes were not generic when all were last tried
  std::size_t unproved_judged = 0;  ///< how many scenes had hardly lost when these were last tried
  bool group_lost = false;  ///< a group lost, so nothing is compiled until trials begin again
  std::map<VolumeId, const kernels::DispatchEntry*>
      without_code;  ///< by volume, for when its compiled code goes
  /// The search of each entry that is bound to data in another way than the analysis chose
  /// (runtime/measured_search.hpp).
  std::map<const kernels::DispatchEntry*, Candidates> searches;
  bool candidates_shown = true;      ///< whether the table shows the candidates of open trials
  unsigned stretches = 0;            ///< stretches of trials since they began or were interrupted
  std::shared_ptr<CodeMaker> maker;  ///< null if nothing is ever compiled
  bool looking = false;              ///< whether the run has begun and its profile is looked at
  bool hopeless = false;             ///< whether nothing can be compiled in this process
  std::set<VolumeId>
      left_out_too_much;   ///< their code bailed out too often; of equal ones the first
  ModuleList module_list;  ///< modules of this run
  std::string module_list_name;
  std::vector<std::uint64_t> steps;  ///< by volume, at the last look
  std::uint64_t locations = 0;       ///< in all volumes, at the last look
  double steps_made = 0;             ///< steps of the run, and locations if these count
  double navigating_ns = 0;          ///< processor time of the process, without the specialiser's
  bool active = false;               ///< whether there was navigation between the last two looks
  double looked_at = 0;              ///< when the last look was, s
  double active_s = 0;               ///< time between looks with steps: the clock of trials
  /// By volume: relocations in it at the end of steps made elsewhere, or where points are located,
  /// as far as samples tell. Written by the specialiser's thread alone, with the mutex locked.
  std::vector<double> relocations;
  std::vector<double> execution_counts;  ///< by volume; the first of equal ones has the sum
  std::vector<double> recent;            ///< the same, with older executions fading away
  double counted_at = 0;                 ///< when the two were updated, s
  /// Processor time that modules were expected to take, and took, as far as they were compiled in
  /// this run: those bound to constants and those of solids, whose expected times were fitted
  /// (runtime/schedule.cpp). Structures are not counted: what they are expected to take is a guess,
  /// and would say little about the machine.
  double expected_ms = 0, compiled_ms = 0;
  std::map<VolumeId, Candidate> candidates;
  /// By volume that was measured to be slower: the execution count at which it will be tried again.
  std::map<VolumeId, double> try_again_at;
  std::map<VolumeId, std::vector<Sample>> samples;
  std::size_t samples_kept = 0;                   ///< in all volumes
  std::map<VolumeId, std::vector<Sample>> fresh;  ///< a few, recorded since the last look
  std::size_t fresh_kept = 0;
  struct Seen {
    std::uint64_t steps = 0, bail_outs = 0;
  };
  std::map<VolumeId, Seen> seen;  ///< of installed scenes, at the last look
  double reconsidered_at = 0;
  Pace pace;  ///< of looks at the profile
  double started_at;
  double process_s_before;  ///< processor time of the process when this was made

  std::stop_source stop;

  mutable std::mutex mutex;  ///< guards the members below
  std::condition_variable_any wake;
  std::map<VolumeId, SceneReport> scenes;
  /// By entry that is bound to data: how many solids of its scene have code that it calls.
  std::map<const kernels::DispatchEntry*, std::size_t> compiled_solids;
  RuntimeReport totals;
};

/// The volume with the most executions of those that share code with `first`, which is the first of
/// them.
VolumeId hottest_equal(const Specialisation& spec, VolumeId first);

/// Must be called when a scene's code is taken out. If the code came from the cache before the
/// scene was bound to data, this lets the scene be bound now.
void have_bound(Specialisation& spec, VolumeId volume);

/// Notes the result for a volume and for all volumes equal to it.
void note(Specialisation& spec, VolumeId volume, SceneStatus status, const std::string& why);

/// The same for the failure of one volume, which is also a warning in the log.
void note_failure(Specialisation& spec, VolumeId volume, const std::string& why);

}  // namespace navjit
