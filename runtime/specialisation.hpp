// All that the specialiser knows and has, as plain data. What it does are functions on it: gather,
// bind to data, choose, make modules, install, watch, report. Private to runtime/.
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

/// If a navigator leaves more than one in this many steps to the generic one, it is made again so
/// that it takes all of them. Leaving them out made LHCb's code some 7% faster, and costs such a
/// step about twice its time; the share itself is a guess.
constexpr std::uint64_t bail_out_share = 8;

/// A scene with fewer recorded states is mostly relocated in, at the end of steps made elsewhere.
/// Replaying its own steps says little, so only the run judges it.
constexpr std::size_t few_recorded = 16;

/// Used by the specialiser's thread alone, except what the mutex guards.
struct Specialisation {
  explicit Specialisation(std::shared_ptr<detail::Shared> runtime);

  bool stopping() const { return stop.stop_requested(); }
  /// Since it was made.
  double seconds() const;
  /// Whether compiling has taken all that it may so far (SpecialiserOptions::compile_share).
  bool allowance_is_used_up() const;
  /// Steps in a volume, and relocations in it, each of which costs about as much as a step.
  double executions(VolumeId volume) const {
    return static_cast<double>(steps[volume]) + relocations[volume];
  }

  /// How many times as long as expected modules took, 1 or more: another machine, or a busy one.
  double slower_than_expected() const {
    return expected_ms > 0 ? std::max(1.0, compiled_ms / expected_ms) : 1.0;
  }

  /// Processor time of the specialiser so far, s: of its thread, which has to be the caller, and of
  /// the compiler, which has threads of its own.
  double own_seconds() const;

  /// Processor time of navigation, s, at the last look: of all that is not the specialiser's.
  double navigated_s() const { return 1e-9 * navigating_ns - process_s_before; }

  /// SpecialiserOptions::poll_ms, within its limits.
  double poll_ms() const;

  /// SpecialiserOptions::compile_weight, less where processors are left.
  double compile_weight() const;

  std::shared_ptr<detail::Shared> shared;
  WorldFacts facts;
  StateSampler sampler;
  std::shared_ptr<codegen::Arena> arena = std::make_shared<codegen::Arena>();  ///< bound data
  std::set<VolumeId> bound;  ///< volumes that need not, or must not, be bound to data (again)
  std::set<VolumeId> off;    ///< volumes that must not be specialised in any way
  /// Volumes for which the environment says how daughters are found; of equal ones the first.
  std::set<VolumeId> forced;
  std::vector<VolumeId> rare_due;   ///< scenes that are to be bound together
  std::uint64_t rare_again_at = 0;  ///< steps of the run before which no others are looked for
  /// By volume: another way to bind it, to be tried once the first was judged.
  std::map<VolumeId, const kernels::DispatchEntry*> second_choices;
  std::uint64_t structures_again_at = 0;  ///< steps of the run before which no structure pays
  std::set<VolumeId> structure_tried;     ///< volumes whose structure was compiled, or need not be
  std::set<std::shared_ptr<const void>> structures;  ///< code of structures, with its tables
  std::optional<std::vector<ComposedSolid>> composed_solids{};  ///< once they were looked for
  codegen::CodeOfSolids code_of_solids;
  Trials trials;
  GroupTrial group;                    ///< scenes that are on trial together
  std::vector<VolumeId> group_judged;  ///< compiled scenes when a group of them was tried last
  std::size_t all_judged = 0;          ///< scenes that were not generic when all were tried last
  std::size_t unproved_judged = 0;     ///< scenes that had hardly lost when these were tried last
  bool group_lost = false;  ///< a group lost: nothing is compiled until trials begin again
  std::map<VolumeId, const kernels::DispatchEntry*>
      without_code;  ///< by volume, for when its compiled code goes
  /// How daughters are found, by record that is bound to data in another way than the analysis
  /// chose (runtime/measured_search.hpp).
  std::map<const kernels::DispatchEntry*, Candidates> searches;
  bool candidates_shown = true;      ///< in the dispatch table, of open trials
  unsigned stretches = 0;            ///< of trials, since they began or were interrupted
  std::shared_ptr<CodeMaker> maker;  ///< null: nothing is ever compiled
  bool looking = false;              ///< the run has begun, and its profile is looked at
  bool hopeless = false;             ///< nothing can be compiled in this process
  std::set<VolumeId>
      left_out_too_much;   ///< their code bailed out too often; of equal ones the first
  ModuleList module_list;  ///< modules of this run
  std::string module_list_name;
  std::vector<std::uint64_t> steps;  ///< by volume, at the last look
  std::uint64_t locations = 0;       ///< in all volumes, likewise
  double steps_made = 0;             ///< steps of the run, and locations where these count
  double navigating_ns = 0;          ///< processor time of the process but the specialiser's, then
  bool active = false;               ///< it was navigated between the last two looks
  double looked_at = 0;              ///< when the last look was, s
  double active_s = 0;               ///< between looks with steps: the clock of trials
  /// By volume: relocations in it at the end of steps made elsewhere, or where points are located,
  /// as far as samples tell. Written by the specialiser's thread alone, with the mutex locked.
  std::vector<double> relocations;
  std::vector<double> execution_counts;     ///< by volume; of all equal ones in the first
  std::vector<double> recent;               ///< the same, fading
  double counted_at = 0;                    ///< when the two were updated, s
  double expected_ms = 0, compiled_ms = 0;  ///< for all modules so far
  std::map<VolumeId, Candidate> candidates;
  /// By volume that was measured to be slower: the execution count at which it is tried again.
  std::map<VolumeId, double> try_again_at;
  std::map<VolumeId, std::vector<Sample>> samples;
  std::size_t samples_kept = 0;                   ///< in all of them
  std::map<VolumeId, std::vector<Sample>> fresh;  ///< a few recorded since they were looked at
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

  mutable std::mutex mutex;  ///< guards what follows
  std::condition_variable_any wake;
  std::map<VolumeId, SceneReport> scenes;
  /// By record that is bound to data: how many solids of its scene have code that it calls.
  std::map<const kernels::DispatchEntry*, std::size_t> compiled_solids;
  RuntimeReport totals;
};

/// The most executed of the volumes that share code with `first`, the first of them.
VolumeId hottest_equal(const Specialisation& spec, VolumeId first);

/// To be called when a scene's code goes. If it came from the cache, before the scene was bound to
/// data, the scene is to be bound now.
void have_bound(Specialisation& spec, VolumeId volume);

/// Notes what became of a volume and all that are equal to it.
void note(Specialisation& spec, VolumeId volume, SceneStatus status, const std::string& why);

/// The same for the failure of one volume; also a warning in the log.
void note_failure(Specialisation& spec, VolumeId volume, const std::string& why);

}  // namespace navjit
