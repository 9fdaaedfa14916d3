// How far runs had got at which time, and what follows from it. Pure functions.
#pragma once

#include <optional>
#include <vector>

namespace navjit::warmup {

/// Steps made since the start of a run, and the processor time that they took; linear in between.
struct Point {
  double seconds = 0, steps = 0, processor_s = 0;
};
/// Times strictly increase; the others do not decrease.
using Series = std::vector<Point>;

/// 0 before the first point; beyond the last one its steps.
double steps_at(const Series& series, double seconds);

/// Steps per second between two times; 0 if the time between them is not positive.
double rate(const Series& series, double from, double to);

/// Steps per second of processor time between two times; 0 if there is none between them.
double processor_rate(const Series& series, double from, double to);

/// The time from which on `run` has made at least as many steps as `baseline` at the same time, for
/// as long as both go on: 0 if it never was behind, nothing if it is behind in the end, or if one
/// of them has no points.
std::optional<double> break_even(const Series& run, const Series& baseline);

/// A scene's specialised navigator came into use.
struct Swap {
  double seconds = 0;  ///< since the start of the run
  double share = 0;    ///< of all steps of the run that are made in the scene
};

/// Share of steps in scenes that are specialised at a time.
double share_at(const std::vector<Swap>& swaps, double seconds);
/// The first time at which it is at least `share`; nothing if it never is.
std::optional<double> time_of_share(const std::vector<Swap>& swaps, double share);

struct Spread {
  double median = 0, low = 0, high = 0;  ///< low and high are the extremes
};
/// Zeros if there are no values.
Spread spread(std::vector<double> values);

}  // namespace navjit::warmup
