// When a ray is stuck: the one rule of all loops that make steps.
#pragma once

namespace navjit::detail {

/// Whether a step (mm) gets a ray ahead. Steps by which a ray crawls along a face on which it
/// stands do not. They may be longer than the tolerance if a coordinate is so large that the
/// addition is rounded away. No real detector has a hundred boundaries so near to one another.
template <class Length>
constexpr bool goes_ahead(const Length& length, double tolerance) {
  return length > Length(1000 * tolerance);
}

/// Counts a ray's steps in a row that do not get it ahead. After 100 of them it is stuck: it would
/// make such steps for ever.
struct Standing {
  static constexpr int most = 100;
  int steps = 0;

  template <class Length>
  constexpr void count(const Length& length, double tolerance) {
    steps = goes_ahead(length, tolerance) ? 0 : steps + 1;
  }
  constexpr bool stuck() const { return steps >= most; }
};

}  // namespace navjit::detail
