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

/// Where more than one in so many steps is left out by a navigator, one that takes them all is
/// made. Leaving them out made LHCb's code some 7% faster and costs such a step about twice its
/// time; the share itself is a guess.
constexpr std::uint64_t bail_out_share = 8;

/// Of a scene with fewer recorded states, which is mostly relocated in at the end of others' steps,
/// replayed steps say little: the run judges alone.
constexpr std::size_t few_recorded = 16;

/// Used by the specialiser's thread alone, but for what the mutex guards.
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

  /// Processor time of the specialiser so far, s: its thread, which has to ask, and the compiler,
  /// which has threads of its own.
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
  /// Of equal volumes the first, where the environment says how daughters are found.
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
  GroupTrial group;                    ///< of what was compiled, once its scenes were tried
  std::vector<VolumeId> group_judged;  ///< compiled scenes when a group of them was tried last
  std::size_t all_judged = 0;          ///< scenes that were not generic when all were tried last
  std::size_t unproved_judged = 0;     ///< scenes that had hardly lost when these were tried last
  bool group_lost = false;             ///< all of it: nothing more is compiled in this phase
  std::map<VolumeId, const kernels::DispatchEntry*> without_code;  ///< what was bound to data
  /// By record that is bound to data, where it finds daughters in another way than the analysis
  /// chose: how (runtime/measured_search.hpp).
  std::map<const kernels::DispatchEntry*, Candidates> searches;
  bool candidates_shown = true;          ///< in the dispatch table, of open trials
  unsigned stretches = 0;                ///< of trials, since they began or were interrupted
  std::shared_ptr<CodeMaker> maker;      ///< null: nothing is ever compiled
  bool looking = false;                  ///< the run has begun, and its profile is looked at
  bool hopeless = false;                 ///< nothing can be compiled in this process
  std::set<VolumeId> left_out_too_much;  ///< of equal volumes the first
  ModuleList module_list;                ///< modules of this run
  std::string module_list_name;
  std::vector<std::uint64_t> steps;  ///< by volume, at the last look
  std::uint64_t locations = 0;       ///< in all volumes, likewise
  double steps_made = 0;             ///< all of these that count
  double navigating_ns = 0;          ///< processor time of all threads but this one, at that look
  bool active = false;               ///< it was navigated between the last two looks
  double looked_at = 0;              ///< when, s
  double active_s = 0;               ///< between looks with steps: the clock of trials
  /// By volume: relocations in it at the end of steps made elsewhere, or where points are located,
  /// as far as samples tell.
  /// Written by the thread alone, with the mutex locked.
  std::vector<double> relocations;
  std::vector<double> execution_counts;     ///< by volume; of all equal ones in the first
  std::vector<double> recent;               ///< the same, fading
  double counted_at = 0;                    ///< when it was updated, s
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
  std::condition_variable wake;
  std::map<VolumeId, SceneReport> scenes;
  /// By record that is bound to data: how many solids of its scene have code that it calls.
  std::map<const kernels::DispatchEntry*, std::size_t> compiled_solids;
  RuntimeReport totals;
};

/// Of volumes that share code, given the first, the one that is executed most.
VolumeId hottest_equal(const Specialisation& spec, VolumeId first);

/// A scene's code goes. Where it came from the cache, before the scene was bound to data, it is to
/// be bound now.
void have_bound(Specialisation& spec, VolumeId volume);

/// Notes what became of a volume and all that are equal to it.
void note(Specialisation& spec, VolumeId volume, SceneStatus status, const std::string& why);

/// Of one volume; also in the log.
void note_failure(Specialisation& spec, VolumeId volume, const std::string& why);

}  // namespace navjit
