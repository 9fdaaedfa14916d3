// What specialisation won, measured rather than estimated.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "navjit/observation.hpp"
#include "navjit/runtime.hpp"
#include "runtime/transport.hpp"

namespace navjit::apps {

/// Some rays once more, by one thread, in turn with the navigators as they are now and with generic
/// ones; steps per second of its processor time.
struct Comparison {
  std::uint64_t rays = 0;
  double with = 0, without = 0;
};

/// For about so long at the most; `options` are those that `specialised` was made with, and
/// `basket` how many rays at once it makes (0: one by one, as the generic ones in any case).
/// Nothing if a signal was noted before there was anything to tell.
std::optional<Comparison> compare_with_generic(Runtime& specialised, const ObservedDetector& seen,
                                               const RuntimeOptions& options,
                                               const std::vector<Ray>& rays, double seconds,
                                               std::size_t basket = 0);

}  // namespace navjit::apps
