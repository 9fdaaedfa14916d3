// Ranges of the numbers that benchmarks are given: nothing is measured by no rays and no
// repetitions, and what is beyond any machine is most likely a slip of the hand.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>

namespace navjit::bench {

/// Rays, and other things of which memory has to hold all.
inline CLI::Range range_of_counts() { return {std::uint64_t{1}, std::uint64_t{1'000'000'000}}; }

inline CLI::Range range_of_repetitions() { return {1, 1'000'000}; }

/// Steps of one particle. All are recorded, with ten times as many boundaries at the most.
inline CLI::Range range_of_steps() { return {1, 1'000'000}; }

/// Seconds: up to a day.
inline CLI::Range range_of_seconds() { return {1e-3, 86400.0}; }

}  // namespace navjit::bench
