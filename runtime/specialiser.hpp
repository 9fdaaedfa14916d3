// The background thread: looks at the profile, decides, generates, compiles, verifies, installs.
#pragma once

#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

#include "analysis/facts.hpp"
#include "runtime/report.hpp"
#include "runtime/shared.hpp"
#include "runtime/states.hpp"

namespace navjit {

class Specialiser {
 public:
  explicit Specialiser(std::shared_ptr<detail::Shared> shared);
  ~Specialiser();

  /// Specialises all volumes of the tree, in the calling thread. Before start() only.
  void specialise_all();
  void start();
  void wait_until_idle();
  /// Ends the thread, after the compilation under way.
  void stop();

  RuntimeReport report() const;
  /// Times scenes that have samples and no timing yet. After stop().
  void time_generic();

 private:
  struct Compiler;

  void run();
  void apply_overrides();
  void gather();
  std::vector<VolumeId> choose();
  void specialise(const std::vector<VolumeId>& batch);
  void compile_module(const std::vector<VolumeId>& batch);
  /// Of a volume and all of equal structure.
  void note(VolumeId volume, SceneStatus status, const std::string& why);
  /// Of one volume; also in the log.
  void note_failure(VolumeId volume, const std::string& why);
  double seconds() const;

  std::shared_ptr<detail::Shared> shared_;
  WorldFacts facts_;
  StateSampler sampler_;
  std::unique_ptr<Compiler> compiler_;
  std::vector<std::uint64_t> steps_;  ///< by volume, at the last look
  /// By volume: steps made in its daughters, as sampled. Many of those end with a relocation in it.
  std::vector<std::uint64_t> steps_below_;
  std::map<VolumeId, std::vector<Sample>> samples_;
  double started_at_;

  mutable std::mutex mutex_;  ///< guards what follows
  std::condition_variable wake_;
  bool stop_ = false;
  std::uint64_t looks_ = 0;  ///< completed passes over the profile
  std::map<VolumeId, SceneReport> scenes_;
  RuntimeReport totals_;

  std::thread thread_;
};

}  // namespace navjit
