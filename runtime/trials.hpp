// Installed navigators are tried in the run's own transport: for short stretches scenes are
// switched between their candidates and the navigators before them, and sampled steps and safeties
// are timed. A navigator that is faster on replayed states need not be faster in a run, where all
// scenes share caches and branch predictors.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "navjit/state.hpp"

namespace navjit::kernels {
struct DispatchEntry;
}

namespace navjit {

/// Durations of sampled steps and safeties, in ticks. There are as many of either as the run asks
/// for, since the time of all of them is what counts.
struct TickSum {
  double count = 0, sum = 0;

  /// Adds a duration. If it is far above `usual` (0: not known), the thread was interrupted, and
  /// the duration is cut.
  void add(double ticks, double usual);
  double mean() const { return count > 0 ? sum / count : 0; }
};

/// The difference between two sides, taken within each pair of stretches. What a run does changes
/// from stretch to stretch, and this must not count for either side.
struct PairedDifference {
  double pairs = 0, weight = 0, sum = 0, weight2 = 0, sum2 = 0, squares2 = 0;

  void add(const TickSum& a, const TickSum& b);
  void add(const PairedDifference& more);
  /// The mean of `a` minus that of `b`, ticks.
  double mean() const { return weight > 0 ? sum / weight : 0; }
  /// Its standard error.
  double error() const;
};

enum class Verdict : std::uint8_t {
  open,   ///< not known yet
  stays,  ///< the candidate is no slower than the navigator before it
  goes,   ///< the candidate is slower
};

struct Trial {
  /// Whether too few steps were timed for a judgement of its own.
  bool is_rare() const;

  const kernels::DispatchEntry* candidate = nullptr;
  const kernels::DispatchEntry* before = nullptr;
  std::shared_ptr<const void> candidate_owner{}, before_owner{};  ///< null if nobody has to keep it
  /// The navigators against which `before` itself was still on trial, the latest first; it may lose
  /// to them. The winner is tried against these, one after the other.
  struct Earlier {
    const kernels::DispatchEntry* entry;
    std::shared_ptr<const void> owner;
  };
  std::vector<Earlier> earlier{};
  Verdict verdict = Verdict::open;
  bool out = false;  ///< whether the navigator before the candidate is installed
  double began = 0;  ///< s
  TickSum with{}, without{};
  TickSum with_now{}, without_now{};  ///< of the present pair of stretches
  PairedDifference lost{};            ///< ticks that the candidate loses
  double allowed = 0;                 ///< ticks that it may lose
  bool to_be_proved = false;          ///< whether it also goes if nothing is known of it
};

/// The trials of a run. Scenes are tried at the same time, because in the end they are used
/// together. Not thread-safe.
class Trials {
 public:
  /// A candidate was installed at time `now`, s of navigation. All that is known of an earlier one
  /// is forgotten.
  void begin(VolumeId volume, Trial trial, double now);
  /// The volume has another navigator, which will not be tried.
  void end(VolumeId volume);
  /// A step in the volume, or its safety, took this time with that navigator.
  void record(VolumeId volume, const kernels::DispatchEntry* used, double ticks);
  bool open() const { return open_ > 0; }
  /// Whether at most one trial in twenty is open. In a run with thousands of scenes new trials
  /// begin all the time.
  bool nearly_all_decided() const { return open_ * 20 <= trials_.size(); }
  /// The volume's winner lost together with others, and `instead` is installed in its place.
  /// Returns false if the volume was not tried.
  bool take_out(VolumeId volume, const kernels::DispatchEntry* instead,
                std::shared_ptr<const void> owner);
  /// The volume's candidate had lost alone, but won together with others, and is installed.
  void take_in(VolumeId volume);
  /// Adds time that other trials took, s.
  void spend(double s) { spent_ += s; }

  struct Of {
    VolumeId volume;
    Trial* trial;
  };
  /// Must be called at the end of a pair of stretches, one with candidates and one without. Decides
  /// what can be decided, and returns the decided trials. After `most_s` of trial all are decided.
  /// Scenes with too few steps of their own are decided as those that share their code.
  std::vector<Of> decide(double now);
  /// Begins all trials again if they have taken less than `most_share` of the run so far, as the
  /// run may have moved on to other states. Returns those that began. Candidates that are out have
  /// to be installed.
  std::vector<Of> begin_again(double now);

  const std::map<VolumeId, Trial>& all() const { return trials_; }

  static constexpr double most_s = 2, most_share = 0.02;

 private:
  void judge_as_others(const std::vector<Trial*>& few);

  std::map<VolumeId, Trial> trials_;
  std::size_t open_ = 0;
  double opened_ = 0, spent_ = 0;  ///< s
};

}  // namespace navjit
