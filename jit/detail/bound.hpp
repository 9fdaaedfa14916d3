// When a compilation must be given up.
#pragma once

#include <stop_token>
#include <string>
#include <utility>

#include "jit/detail/processor_time.hpp"
#include "navjit/detail/expected.hpp"

namespace navjit::jit::detail {

/// Is reached once a stop is requested, or once the thread has taken too much processor time since
/// the construction. For use by one thread.
class Bound {
 public:
  Bound(std::stop_token stop, double most_ms)
      : stop_(std::move(stop)), most_ms_(most_ms), end_ms_(now_ms() + most_ms) {}

  /// Once this is true it stays true.
  bool is_reached() const {
    late_ = late_ || now_ms() > end_ms_;
    return late_ || stop_.stop_requested();
  }
  /// The failure of a compilation whose bound was reached.
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
