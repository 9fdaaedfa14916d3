// Finds the daughter in whose tree a touchable is.
#pragma once

#include <algorithm>
#include <cstddef>

#include "navjit/state.hpp"

namespace navjit {

/// The number of daughters for each touchable, if all of their trees are of one size, as those of
/// most mothers are; 0 without daughters.
template <class Daughters>
double daughters_per_touchable(const Daughters& daughters) {
  if (daughters.size() < 2) return 0;
  const std::size_t last = daughters.size() - 1;
  // A little more than that, so that rounding never gives the daughter before the right one.
  constexpr double upwards = 1 + 0x1p-50;
  return upwards * static_cast<double>(last) / static_cast<double>(daughters[last].offset - 1);
}

/// The number of the daughter whose tree holds the touchable that is `below` > 0 after its mother:
/// the last daughter that starts at or before it. There is at least one daughter, and the first
/// starts at 1. `per_touchable` is daughters_per_touchable(): the search starts where that expects
/// it (W. W. Peterson, "Addressing for random-access storage", 1957), since each comparison of a
/// binary search waits for memory, and for branches that were predicted wrongly.
template <class Daughters>
std::size_t daughter_holding(const Daughters& daughters, TouchableId below, double per_touchable) {
  const std::size_t last = daughters.size() - 1;
  const auto guess =
      std::min(static_cast<std::size_t>(static_cast<double>(below - 1) * per_touchable), last);
  std::size_t from = 0, to = last + 1;  // the first that starts after it is in [from, to]
  if (below < daughters[guess].offset) {
    to = guess;
  } else if (guess == last || below < daughters[guess + 1].offset) {
    return guess;
  } else {
    from = guess + 2;
  }
  const auto after = std::upper_bound(
      daughters.begin() + static_cast<std::ptrdiff_t>(from),
      daughters.begin() + static_cast<std::ptrdiff_t>(to), below,
      [](TouchableId value, const auto& daughter) { return value < daughter.offset; });
  return static_cast<std::size_t>(after - daughters.begin() - 1);
}

/// The same for callers that ask once.
template <class Daughters>
std::size_t daughter_holding(const Daughters& daughters, TouchableId below) {
  return daughter_holding(daughters, below, daughters_per_touchable(daughters));
}

}  // namespace navjit
