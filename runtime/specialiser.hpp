// The background thread: looks at the profile, decides, generates, compiles, verifies, installs.
#pragma once

#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <stop_token>
#include <thread>

#include "analysis/facts.hpp"
#include "codegen/data/arena.hpp"
#include "codegen/module.hpp"
#include "navjit/report.hpp"
#include "navjit/step_profile.hpp"
#include "runtime/code_maker.hpp"
#include "runtime/module_list.hpp"
#include "runtime/schedule.hpp"
#include "runtime/shared.hpp"
#include "runtime/states.hpp"

namespace navjit {

/// Where more than one in so many steps is left out by a navigator, one that takes them all is
/// made. Leaving them out made LHCb's code some 7% faster and costs such a step about twice its
/// time; the share itself is a guess.
constexpr std::uint64_t bail_out_share = 8;

/// Owned by its Runtime, and by its thread as long as that runs: a compilation that is under way
/// when the Runtime goes is left to itself.
class Specialiser : public std::enable_shared_from_this<Specialiser> {
 public:
  explicit Specialiser(std::shared_ptr<detail::Shared> shared);

  /// Specialises all volumes of the tree, in the calling thread. Before start() only.
  void specialise_all();
  /// Verifies and installs the scenes of a plugin, in the calling thread. Before start() only.
  void install_plugin(const std::string& path);
  /// Where there is no thread to be had, nothing is specialised, and the log says so.
  void start();
  void wait_until_idle();
  /// Ends the thread, or leaves it to the compilation that it is at: that is asked to stop, and
  /// whatever comes of it is dropped. The calling thread may use what is the thread's from then on.
  void stop();

  RuntimeReport report() const;
  std::size_t specialised() const;
  /// Times scenes that have samples and no timing yet, and tells the structure of scenes, the
  /// hottest first, for a limited time. After stop().
  void time_generic(double most_seconds);
  /// Holds scenes that made steps to options.budget, which is given (budget.cpp). After stop().
  void hold_to_budget();
  /// What was counted so far, for a file. After stop().
  StepProfile step_profile();

 private:
  void run();
  void look_until_stopped();
  bool stopping() const { return stop_.stop_requested(); }
  void apply_overrides();
  void gather();
  void update_execution_counts();
  std::vector<VolumeId> choose();
  /// Not tried yet, or long enough ago that trying again may pay.
  bool may_be_tried(VolumeId volume);
  /// Those whose plan promises a gain; notes what becomes of each.
  std::vector<VolumeId> worth_trying(const std::vector<VolumeId>& batch);
  void specialise(const std::vector<VolumeId>& batch);

  // In bind_to_data.cpp:
  /// Binds what is hot and not bound yet, the hottest first, for some ms. True if more is left.
  bool bind_hot_to_data();
  /// Verifies, times and installs a navigator of the library with this scene's numbers, if it is
  /// faster than the generic one on the states at hand.
  void bind_to_data(VolumeId volume);
  /// Of a step of the data-bound navigator that is installed, ns; infinite if none is.
  double bound_ns(VolumeId volume) const;

  // In specialise_module.cpp:
  /// Whether many steps of these scenes are along faces: then their navigators have to take them.
  bool takes_rays_along_faces(const std::vector<VolumeId>& batch);
  codegen::Module generate(const std::vector<VolumeId>& batch, bool along_faces);
  /// From the cache, or compiled. False if the module could not be made; then its scenes were tried
  /// alone.
  bool make_module(const std::vector<VolumeId>& batch);
  /// Verifies and installs what is good. False if something is not; where code came from the cache
  /// it ends there, and notes no failure.
  bool install(const codegen::Module& module, jit::Code code, bool cached, double start);
  /// Verifies, times and installs one scene; `found` says what was wrong with it.
  bool install_scene(VolumeId volume, const kernels::DispatchEntry& record,
                     const std::shared_ptr<const void>& owner, bool only_if_faster,
                     SceneReport& report, std::string& problem);
  Expected<CodeMaker::Made> compile(const std::string& source);
  /// What the cost model says of a module, ms; 0 if it was not asked about all of its scenes.
  double expected_ms(const std::vector<VolumeId>& batch) const;
  void no_module(const std::vector<VolumeId>& batch, const Failure& failure);
  /// Installs what earlier runs found hot, as far as the cache has the code.
  void install_remembered();
  void remember(const std::vector<VolumeId>& batch);
  // In deoptimise.cpp:
  /// Looks at what is installed: bail-outs, and answers on states recorded since.
  void reconsider();
  /// For a scene whose navigator leaves out too many of the steps.
  void make_again(VolumeId volume, std::uint64_t bail_outs, std::uint64_t steps);
  /// Back to the generic navigator.
  void deoptimise(VolumeId volume, SceneStatus status, const std::string& why);
  /// Of a volume and all of equal structure.
  void note(VolumeId volume, SceneStatus status, const std::string& why);
  /// Of one volume; also in the log.
  void note_failure(VolumeId volume, const std::string& why);
  double seconds() const;

  std::shared_ptr<detail::Shared> shared_;
  WorldFacts facts_;
  StateSampler sampler_;
  std::shared_ptr<codegen::Arena> arena_ = std::make_shared<codegen::Arena>();  ///< bound data
  std::set<VolumeId> bound_;  ///< volumes that need not, or must not, be bound to data (again)
  std::unique_ptr<CodeMaker> maker_;      ///< null: nothing is ever specialised
  bool hopeless_ = false;                 ///< nothing can be compiled in this process
  std::set<VolumeId> left_out_too_much_;  ///< of equal volumes the first
  ModuleList module_list_;                ///< modules of this run
  std::string module_list_name_;
  std::vector<std::uint64_t> steps_;  ///< by volume, at the last look
  /// By volume: steps made in its daughters, as sampled. Many of those end with a relocation in it.
  std::vector<std::uint64_t> steps_below_;
  std::vector<double>
      execution_counts_;        ///< by volume, of all of equal structure in the first of them
  std::vector<double> recent_;  ///< the same, fading
  double counted_at_ = 0;       ///< when it was updated, s
  std::map<VolumeId, Candidate> candidates_;
  /// By volume that was measured to be slower: the executions at which it is tried again.
  std::map<VolumeId, double> try_again_at_;
  std::map<VolumeId, std::vector<Sample>> samples_;
  std::map<VolumeId, std::vector<Sample>> fresh_;  ///< a few recorded since the last look
  struct Seen {
    std::uint64_t steps = 0, bail_outs = 0;
  };
  std::map<VolumeId, Seen> seen_;  ///< of installed scenes, at the last look
  double reconsidered_at_ = 0;
  double started_at_;

  std::stop_source stop_;

  mutable std::mutex mutex_;  ///< guards what follows
  std::condition_variable wake_;
  bool compiling_ = false;       ///< the thread is in the compiler, and uses nothing but `maker_`
  bool ended_ = false;           ///< the thread uses nothing any more
  std::uint64_t looks_ = 0;      ///< completed passes over the profile
  std::uint64_t idle_look_ = 0;  ///< the last that found nothing to do
  std::map<VolumeId, SceneReport> scenes_;
  RuntimeReport totals_;

  std::thread thread_;
};

}  // namespace navjit
