// What the navigation of one thread tells the specialiser: the number of steps in each volume, how
// many points were located, and now and then a whole question as it was asked. The navigating
// thread writes it, one other thread reads it; there are no locks.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>

#include "navjit/detail/api.hpp"
#include "navjit/state.hpp"

namespace navjit::kernels {
struct DispatchEntry;
}

namespace NAVJIT_API navjit {

enum class Question : std::uint8_t { step, safety, location };

/// A recorded question.
struct Sample {
  static constexpr VolumeId no_volume = ~VolumeId{0};

  TouchableId touchable;
  VolumeId volume;
  Vec3 point, direction;
  double limit;
  unsigned left = 0;  ///< the daughter that was left last, or any number: no answer depends on it
  bool left_for_good = false;                    ///< whether for good (LeftForGood)
  const kernels::DispatchEntry* used = nullptr;  ///< what made the step, if it was timed
  std::uint64_t ticks = 0;                       ///< how long that took
  Question question = Question::step;            ///< for a location only what follows matters

  /// The part that a volume had in a step that began in another one, or in a location.
  struct Relocation {
    VolumeId volume = no_volume;
    const kernels::DispatchEntry* used = nullptr;
  };
  /// More volumes than this seldom take part.
  static constexpr unsigned most_relocations = 8;
  /// The volumes in which the track was relocated at the step's end, first outwards from the mother
  /// of what was left, then inwards; or those in which the point was located, inwards. Volumes
  /// without daughters are not among them.
  Relocation relocations[most_relocations]{};
  unsigned relocation_count = 0;
};

class Profile {
 public:
  explicit Profile(std::size_t volumes)
      : size_(volumes),
        steps_(std::make_unique<std::atomic<std::uint64_t>[]>(volumes)),
        bail_outs_(std::make_unique<std::atomic<std::uint64_t>[]>(volumes)) {}

  /// For the owner, which is the only writer: so this need not be an atomic increment.
  void count(VolumeId volume) {
    std::atomic<std::uint64_t>& n = steps_[volume];
    n.store(n.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }
  /// For the owner, in addition to count(): a specialised navigator did not take the state.
  void count_bail_out(VolumeId volume) {
    std::atomic<std::uint64_t>& n = bail_outs_[volume];
    n.store(n.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }
  /// For the owner, once a step: true if the step should be recorded.
  bool due() { return --countdown_ == 0; }
  /// For the owner: the next step should be recorded, too.
  void come_again() { countdown_ = 1; }
  /// For the owner, once a safety: true if it should be recorded.
  bool safety_due() { return --safety_countdown_ == 0; }
  /// For the owner, once a location: counts it; true if it should be recorded.
  bool location_due() {
    locations_.store(locations_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    return --location_countdown_ == 0;
  }
  /// For the owner. A full queue drops the sample, and then samples are rare until there is room
  /// again. So the reader decides how many it gets by how often it looks.
  void record(const Sample& sample) {
    const std::uint32_t head = head_.load(std::memory_order_relaxed);
    const bool full = head - tail_.load(std::memory_order_acquire) == queue_.size();
    countdown_of(sample.question) = full ? period_when_full : period;
    if (full) return;
    queue_[head % queue_.size()] = sample;
    head_.store(head + 1, std::memory_order_release);
  }

  /// For the owner, at the end: nothing is counted after this.
  void finish() { finished_.store(true, std::memory_order_release); }
  bool finished() const { return finished_.load(std::memory_order_acquire); }

  /// For the reader.
  std::uint64_t steps(VolumeId volume) const {
    return steps_[volume].load(std::memory_order_relaxed);
  }
  std::uint64_t bail_outs(VolumeId volume) const {
    return bail_outs_[volume].load(std::memory_order_relaxed);
  }
  std::uint64_t locations() const { return locations_.load(std::memory_order_relaxed); }
  std::size_t size() const { return size_; }
  /// For the reader: takes the oldest sample; false if there is none.
  bool take(Sample& sample) {
    const std::uint32_t tail = tail_.load(std::memory_order_relaxed);
    if (tail == head_.load(std::memory_order_acquire)) return false;
    sample = queue_[tail % queue_.size()];
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }

  /// Steps between samples; prime, so that it does not beat with periods of the detector.
  static constexpr std::uint32_t period = 61;
  /// The same while the queue is full, since nobody takes the samples out. It is prime,
  /// too.
  static constexpr std::uint32_t period_when_full = 2039;

 private:
  std::uint32_t& countdown_of(Question question) {
    switch (question) {
      case Question::safety:
        return safety_countdown_;
      case Question::location:
        return location_countdown_;
      case Question::step:
        break;
    }
    return countdown_;
  }

  std::size_t size_;
  std::unique_ptr<std::atomic<std::uint64_t>[]> steps_, bail_outs_;
  std::atomic<std::uint64_t> locations_{0};
  std::uint32_t countdown_ = 1, safety_countdown_ = 1, location_countdown_ = 1;
  std::array<Sample, 1024> queue_;
  std::atomic<std::uint32_t> head_{0}, tail_{0};
  std::atomic<bool> finished_{false};
};

}  // namespace navjit
