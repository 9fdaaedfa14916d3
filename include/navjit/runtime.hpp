// The runtime that a simulation embeds.
#pragma once

#include <memory>

#include "navjit/basket.hpp"
#include "navjit/detail/api.hpp"
#include "navjit/detector.hpp"
#include "navjit/navigator.hpp"
#include "navjit/options.hpp"
#include "navjit/report.hpp"
#include "navjit/step_profile.hpp"

namespace NAVJIT_API navjit {

class Specialiser;

/// Owns a detector's navigation: the generic navigators, and the thread that specialises hot scenes
/// while navigators are in use. Navigators may outlive it; then no more scenes are specialised.
///
/// Nothing waits for the compiler. A compilation that is under way when the Runtime is destroyed,
/// or is asked for its final report, is told to stop; until then it goes on by itself, with what it
/// needs of the Runtime. Only the end of the process, by exit() or a return from main, waits for
/// it, since that destroys what the compiler uses. It stops within the pass, or the function, that
/// it is at, mostly in less than 0.1 s. A program that cannot wait leaves by _exit().
///
/// The child of a fork() has the navigators as they are, and may make more, but the thread that
/// specialises stays in the parent: in the child nothing more is specialised, and reports measure
/// nothing. A child that wants this makes a Runtime of its own. The compiler cannot be used in the
/// child if it was at work when the parent forked: call wait_until_idle() before fork().
class Runtime {
 public:
  /// Throws GeometryError if the options name a volume that is not there, and UsageError if a
  /// number among them makes no sense.
  explicit Runtime(const Detector& detector, RuntimeOptions options = {});
  Runtime(const Runtime&) = delete;
  Runtime& operator=(const Runtime&) = delete;
  ~Runtime();

  /// A navigator for the calling thread. Thread-safe.
  Navigator navigator();
  /// The same for programs that step many tracks at once; `places` says how many. Throws UsageError
  /// if that is 0. Thread-safe.
  Basket basket(std::size_t places);

  /// The detector that is navigated.
  const Detector& detector() const { return detector_; }
  /// For the library's own parts.
  const World& world() const { return *detector_.model(); }
  /// For the library's own parts.
  const std::shared_ptr<const World>& share_world() const { return detector_.model(); }
  /// Steps and specialisations so far. Thread-safe; cheap enough for a progress line.
  RuntimeReport report() const;
  /// How many scenes have navigators of their own by now. Thread-safe; cheaper than a report.
  std::size_t specialised() const;
  /// As report(). It also times the generic navigator on recorded states of scenes that were not
  /// specialised, the hottest first, for a tenth of the time so far and no longer than
  /// `most_seconds`, and checks scenes against the budget; with 0 neither. No scene is specialised
  /// after it. Not thread-safe, but navigators may be in use.
  RuntimeReport final_report(double most_seconds = 1);
  /// How often each volume was used so far, to be kept for `navjit specialise`. It may be called
  /// while the run goes on, from one thread at a time, but not beside final_report().
  StepProfile step_profile();
  /// Returns when no specialisation is under way, and none is due on what was counted until now.
  /// Thread-safe, but not beside final_report().
  void wait_until_idle();

 protected:
  /// For the library's own tests.
  Runtime(Detector detector, std::shared_ptr<detail::Shared> shared);

 private:
  Detector detector_;
  std::shared_ptr<detail::Shared> shared_;
  std::shared_ptr<Specialiser> specialiser_;
};

}  // namespace navjit
