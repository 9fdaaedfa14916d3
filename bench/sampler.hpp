// Where a thread is: looked at by a timer some ten thousand times a second, or after every
// instruction.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace navjit::bench {

/// What the thread that is sampled says it is at; written by it before each step.
extern thread_local volatile std::uint32_t sampled_scene;

struct CodeSample {
  std::uint64_t address;  ///< of the next instruction to finish
  std::uint32_t scene;
};

/// Samples the thread that made it. One at a time in a process. Throws Error where
/// there is no timer to be had.
class Sampler {
 public:
  /// What comes after so many samples is passed over.
  static constexpr std::size_t most_samples = 8'000'000;

  Sampler();
  ~Sampler();
  Sampler(const Sampler&) = delete;
  Sampler& operator=(const Sampler&) = delete;

  /// By the timer, from start() to stop().
  void start();
  void stop();
  /// After every instruction between the two, by the processor's trap flag: some microseconds each.
  /// False where that is not known how (x86-64 only).
  static bool start_stepping();
  static void stop_stepping();
  /// The samples since the last call.
  std::vector<CodeSample> take();

 private:
  void* timer_ = nullptr;
};

}  // namespace navjit::bench
