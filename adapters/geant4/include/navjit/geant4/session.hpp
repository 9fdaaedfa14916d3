// What the threads of a run share.
#pragma once

#include <G4VPhysicalVolume.hh>
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "navjit/geant4/geometry.hpp"
#include "navjit/geant4/tally.hpp"
#include "navjit/runtime.hpp"

namespace navjit::geant4 {

/// Who answers Geant4.
enum class Mode : std::uint8_t {
  navjit,
  geant4,  ///< Geant4's own navigator; its calls are counted and timed, to know what is to be won
  shadow,  ///< navjit, and Geant4's own is asked the same; differences are counted and printed
};

/// How navjit shall work within Geant4.
struct Options {
  Mode mode = Mode::navjit;
  RuntimeOptions runtime{};
  /// How many differences a thread prints in shadow mode.
  int printed_differences = 20;
};

/// What Geant4 asks of a navigator.
enum class Call : std::uint8_t { step, locate, relocate_within, safety, reset, normal };
constexpr std::size_t call_kinds = 6;
/// In words.
const char* call_name(Call call);

using Count = Tally<std::uint64_t>;

/// Calls of one kind, and the time that they took: of one in `sampled_calls` it is measured.
struct CallCount {
  Count calls;
  Count sampled;
  Tally<double> sampled_seconds;
  /// Of all calls, s; `clock`: what the clock itself adds to a sample, s.
  double seconds(double clock) const {
    if (sampled == 0) return 0;
    return (sampled_seconds / static_cast<double>(sampled) - clock) * static_cast<double>(calls);
  }
};
constexpr std::uint64_t sampled_calls = 256;  ///< a power of two
/// What samples are timed with, s.
double sampling_time();

/// In shadow mode: how often the two navigators disagreed.
struct Differences {
  Count steps;      ///< compared
  Count lengths;    ///< that differ by more than 1e-6 mm, or of which one has a boundary
  Count locates;    ///< compared
  Count histories;  ///< that differ in a volume or number
  Count ties;       ///< likewise, with the point on a face: either is right
  Count safeties;   ///< of navjit that reach farther than a step of Geant4's
  Count normals;    ///< that differ by more than 1e-3
  Tally<double> largest_length;  ///< mm, of those that agree
  std::uint64_t total() const { return lengths + histories + safeties + normals; }
};

/// One thread's part, or the sum of all.
struct Counts {
  std::array<CallCount, call_kinds> calls{};
  Differences differences{};
  Count zero_steps;
  Count pushed;     ///< tracks that did not move for ten steps, and were moved on
  Count abandoned;  ///< tracks that did not move for 25

  void add(const Counts& other);
};

/// A world and how it is navigated.
struct Engine {
  Geometry geometry;
  Runtime runtime;

  Engine(G4VPhysicalVolume& world, const RuntimeOptions& options)
      : geometry(world), runtime(geometry.detector(), options) {}
};

/// What the threads of a run share: the options, the world as navjit has it once a thread needs it,
/// and the counts. Thread-safe.
class Session {
 public:
  explicit Session(Options options);

  const Options& options() const { return options_; }
  /// The world as navjit has it; null where it cannot be, for which Geant4 gets one warning that
  /// says why. The first call converts it.
  std::shared_ptr<Engine> engine(G4VPhysicalVolume& world);
  /// That world, where it was converted.
  std::shared_ptr<Engine> present_engine() const;
  /// Forgets a world that changed; the next call of engine() converts it anew.
  void geometry_changed();
  /// How often that was.
  std::uint64_t generation() const { return generation_.load(std::memory_order_acquire); }
  /// Why there is no engine; empty if there is one, or none was asked for.
  std::string refusal() const;

  /// A navigator's, which adds to it. Counted in counts() as it is then.
  std::shared_ptr<Counts> new_counts();
  /// Of all navigators so far. Threads may navigate meanwhile; what they count then may be missing.
  Counts counts() const;
  /// Of the whole process since the session was made.
  double processor_seconds() const;

 private:
  Options options_;
  mutable std::mutex mutex_;
  std::shared_ptr<Engine> engine_;
  std::string refusal_;
  const G4VPhysicalVolume* refused_ = nullptr;
  std::atomic<std::uint64_t> generation_{1};
  std::vector<std::shared_ptr<Counts>> counts_;
  double made_at_;  ///< the process's processor time, s
};

}  // namespace navjit::geant4
