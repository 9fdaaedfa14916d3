// Which daughter's tree a touchable is in.
#pragma once

#include <algorithm>
#include <cstddef>

#include "navjit/state.hpp"

namespace navjit {

/// How many daughters there are to a touchable, if all of their trees are of one size, as those of
/// most mothers are; 0 without daughters.
template <class Daughters>
double daughters_per_touchable(const Daughters& daughters) {
  if (daughters.size() < 2) return 0;
  const std::size_t last = daughters.size() - 1;
  // A little more than that: where a tree begins must not be rounded to the one before.
  constexpr double upwards = 1 + 0x1p-50;
  return upwards * static_cast<double>(last) / static_cast<double>(daughters[last].offset - 1);
}

/// The number of the daughter whose tree holds the touchable that is `below` > 0 after its mother:
/// the last that starts at or before it. There is at least one daughter, and the first starts at 1.
/// `per_touchable`: daughters_per_touchable(). Looks first where it is if that is right (W. W.
/// Peterson, "Addressing for random-access storage", 1957): each comparison of a binary search
/// waits for memory, and for what the processor did not foresee.
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

/// The same, where it is asked once.
template <class Daughters>
std::size_t daughter_holding(const Daughters& daughters, TouchableId below) {
  return daughter_holding(daughters, below, daughters_per_touchable(daughters));
}

}  // namespace navjit
