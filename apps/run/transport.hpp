// The transport of `navjit run`: rays on several threads, watched by the calling one.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "common/rays.hpp"
#include "navjit/observation.hpp"
#include "navjit/runtime.hpp"

namespace navjit::apps {

/// What the rays came to. Sums of lengths do not depend on the number of threads.
struct Transport {
  std::uint64_t rays = 0, steps = 0, stuck = 0;  ///< made: fewer rays than asked for if stopped
  std::uint64_t outside = 0;                     ///< rays that start outside the world
  std::uint64_t bail_outs = 0, differences = 0;  ///< NavigatorCounts
  double length_mm = 0;
  unsigned threads = 0;
  double seconds = 0;        ///< wall time
  double cpu_seconds = 0;    ///< processor time of the navigating threads
  double watch_seconds = 0;  ///< and of the one that watched
  /// Steps so far at some moments, s since the first ray; none where nobody watched.
  std::vector<std::pair<double, std::uint64_t>> series{};
  double begun_s = 0;             ///< of the runtime's own time
  std::vector<Ray> first_rays{};  ///< the first of them, to be made once more
  /// Steps per second of wall time after the last swap; over the whole run where there was none, or
  /// hardly any time after it.
  double warm_steps_per_second = 0;
};

/// So many rays, and those that complete their chunk, are kept.
constexpr std::size_t rays_kept = 1 << 16;

/// Transports the rays with a progress line on a terminal, until all are made or a signal was noted
/// (common/interruption.hpp). Throws what common::in_parallel, RayStream and navigators throw.
/// `runtime` navigates what is left of `seen`. `basket`: so many rays at once in each thread; 0:
/// one by one, with the same sums to the last bit. It stops as well once `in_vain` is set.
Transport transport_rays(Runtime& runtime, const ObservedDetector& seen, common::RayStream& rays,
                         unsigned threads, std::size_t basket, const std::atomic<bool>& in_vain);

}  // namespace navjit::apps
