// A number that one thread counts and that others may read meanwhile.
#pragma once

#include <atomic>

namespace navjit::geant4 {

/// Works as a plain number, but others that read while its owner adds see one of its values. It
/// needs no atomic increment, since there is one writer.
template <typename Number>
class Tally {
 public:
  Tally() = default;
  Tally(const Tally& other) : value_(other) {}
  Tally& operator=(const Tally& other) { return *this = static_cast<Number>(other); }
  Tally& operator=(Number value) {
    value_.store(value, std::memory_order_relaxed);
    return *this;
  }
  operator Number() const { return value_.load(std::memory_order_relaxed); }

  /// Returns the sum.
  Number operator+=(Number more) {
    const Number sum = *this + more;
    *this = sum;
    return sum;
  }
  Number operator++() { return *this += 1; }

 private:
  std::atomic<Number> value_{};
};

}  // namespace navjit::geant4
