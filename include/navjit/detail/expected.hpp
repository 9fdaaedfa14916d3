// A value, or the reason why there is none: the result of what can fail without throwing.
#pragma once

#include <string>
#include <utility>
#include <variant>

namespace navjit {

/// Why an operation did not succeed: every diagnostic in one string, ready to be shown.
struct Failure {
  std::string message;
  /// Memory or threads ran out: the next try would hardly do better.
  bool exhausted = false;
  /// The operation was asked to stop.
  bool stopped = false;
};

/// The failure of an operation that was asked to stop.
inline Failure stopped() { return {.message = "stopped", .stopped = true}; }
/// The failure of an operation that ran out of memory. To make it takes none.
inline Failure out_of_memory() { return {.message = "out of memory", .exhausted = true}; }

/// Either a value or the `Failure` that kept it from being made. It owns the one that it holds.
template <typename T>
class [[nodiscard]] Expected {
 public:
  Expected(T result) : state_(std::in_place_index<0>, std::move(result)) {}
  Expected(Failure reason) : state_(std::in_place_index<1>, std::move(reason)) {}

  bool has_value() const { return state_.index() == 0; }
  explicit operator bool() const { return has_value(); }

  /// The value. Throws `std::bad_variant_access` if there is none.
  T& value() & { return std::get<0>(state_); }
  const T& value() const& { return std::get<0>(state_); }
  T&& value() && { return std::get<0>(std::move(state_)); }

  /// Same as `value()`.
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

  /// The failure. Throws `std::bad_variant_access` if there is a value.
  const Failure& failure() const { return std::get<1>(state_); }

 private:
  std::variant<T, Failure> state_;
};

}  // namespace navjit
