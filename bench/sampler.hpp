// Where a thread is in its code: seen by a timer some ten thousand times a second, or after every
// instruction.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace navjit::bench {

/// The scene that the sampled thread is in; the thread sets it before each step.
extern thread_local volatile std::uint32_t sampled_scene;

struct CodeSample {
  std::uint64_t address;  ///< of the next instruction to finish
  std::uint32_t scene;
};

/// Samples the thread that made it. There can be one at a time in a process. Throws Error if no
/// timer is available.
class Sampler {
 public:
  /// Samples after so many are dropped.
  static constexpr std::size_t most_samples = 8'000'000;

  Sampler();
  ~Sampler();
  Sampler(const Sampler&) = delete;
  Sampler& operator=(const Sampler&) = delete;

  /// Samples by the timer, from start() to stop().
  void start();
  void stop();
  /// Samples after every instruction until stop(), by the processor's trap flag: some microseconds
  /// each. False where this is not supported (it is on x86-64 only).
  static bool start_stepping();
  static void stop_stepping();
  /// The samples since the last call.
  std::vector<CodeSample> take();

 private:
  void* timer_ = nullptr;
};

}  // namespace navjit::bench
