// When a compilation is to be given up.
#pragma once

#include <stop_token>
#include <string>
#include <utility>

#include "jit/detail/processor_time.hpp"
#include "navjit/detail/expected.hpp"

namespace navjit::jit::detail {

/// Reached once a stop is requested, or once it is too late. For one thread: its processor time
/// counts from the construction on.
class Bound {
 public:
  Bound(std::stop_token stop, double most_ms)
      : stop_(std::move(stop)), most_ms_(most_ms), end_ms_(now_ms() + most_ms) {}

  /// Once true it stays so.
  bool is_reached() const {
    late_ = late_ || now_ms() > end_ms_;
    return late_ || stop_.stop_requested();
  }
  /// What a compilation fails with then.
  Failure failure() const {
    if (stop_.stop_requested()) return stopped();
    return {.message = "takes more than " + std::to_string(static_cast<long>(most_ms_)) +
                       " ms to compile"};
  }

 private:
  static double now_ms() { return 1e3 * ProcessorTime::of_this_thread(); }

  std::stop_token stop_;
  double most_ms_, end_ms_;
  mutable bool late_ = false;
};

}  // namespace navjit::jit::detail
