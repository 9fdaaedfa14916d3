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

/// Which navigator answers Geant4.
enum class Mode : std::uint8_t {
  navjit,
  geant4,  ///< Geant4's own; its calls are counted and timed, to see what can be gained
  shadow,  ///< navjit's; Geant4's is asked the same, and differences are counted and printed
};

/// How navjit is to work within Geant4.
struct Options {
  Mode mode = Mode::navjit;
  RuntimeOptions runtime{};
  /// How many differences a thread prints in shadow mode.
  int printed_differences = 20;
};

/// What Geant4 asks of a navigator.
enum class Call : std::uint8_t { step, locate, relocate_within, safety, reset, normal };
constexpr std::size_t call_kinds = 6;
/// The name of a call, in words.
const char* call_name(Call call);

using Count = Tally<std::uint64_t>;

/// Calls of one kind, and the time that they took: one in `sampled_calls` is timed.
struct CallCount {
  Count calls;
  Count sampled;
  Tally<double> sampled_seconds;
  /// The time of all calls, s. `clock` is what the clock itself adds to a sample, s.
  double seconds(double clock) const {
    if (sampled == 0) return 0;
    return (sampled_seconds / static_cast<double>(sampled) - clock) * static_cast<double>(calls);
  }
};
constexpr std::uint64_t sampled_calls = 256;  ///< a power of two
/// The time that the clock adds to a sample, s.
double sampling_time();

/// In shadow mode: how often the two navigators disagreed.
struct Differences {
  Count steps;      ///< compared
  Count lengths;    ///< that differ by more than 1e-6 mm, or of which only one ends on a boundary
  Count locates;    ///< compared
  Count histories;  ///< that differ in a volume or number
  Count ties;       ///< as `histories`, but the point is on a face: either is right
  Count safeties;   ///< those of navjit's that reach farther than a step of Geant4's
  Count normals;    ///< that differ by more than 1e-3
  Tally<double> largest_length;  ///< the largest difference of those that agree, mm
  std::uint64_t total() const { return lengths + histories + safeties + normals; }
};

/// The counts of one thread, or the sum of all.
struct Counts {
  std::array<CallCount, call_kinds> calls{};
  Differences differences{};
  Count zero_steps;
  Count pushed;     ///< tracks that did not move for ten steps, and were moved on
  Count abandoned;  ///< tracks that did not move for 25

  void add(const Counts& other);
};

/// A world, and how navjit navigates it.
struct Engine {
  Geometry geometry;
  Runtime runtime;

  Engine(G4VPhysicalVolume& world, const RuntimeOptions& options)
      : geometry(world), runtime(geometry.detector(), options) {}
};

/// What the threads of a run share: the options, navjit's form of the world once a thread needs it,
/// and the counts. Thread-safe.
class Session {
 public:
  explicit Session(Options options);

  const Options& options() const { return options_; }
  /// navjit's form of the world; null if there can be none: then Geant4 gets one warning, which
  /// says why. The first call converts the world.
  std::shared_ptr<Engine> engine(G4VPhysicalVolume& world);
  /// The same, if the world has been converted.
  std::shared_ptr<Engine> present_engine() const;
  /// Forgets a world that changed; the next call of engine() converts it anew.
  void geometry_changed();
  /// How often geometry_changed() was called.
  std::uint64_t generation() const { return generation_.load(std::memory_order_acquire); }
  /// Why there is no engine; empty if there is one, or if none was asked for.
  std::string refusal() const;

  /// Counts for one navigator, which adds to them. counts() includes them as they are then.
  std::shared_ptr<Counts> new_counts();
  /// The counts of all navigators so far. What threads count meanwhile may be missing.
  Counts counts() const;
  /// The processor time of the whole process since the session was made.
  double processor_seconds() const;

 private:
  Options options_;
  mutable std::mutex mutex_;
  std::shared_ptr<Engine> engine_;
  std::string refusal_;
  const G4VPhysicalVolume* refused_ = nullptr;
  std::atomic<std::uint64_t> generation_{1};
  std::vector<std::shared_ptr<Counts>> counts_;
  double made_at_;  ///< the processor time of the process then, s
};

}  // namespace navjit::geant4
