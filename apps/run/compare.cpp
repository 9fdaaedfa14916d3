#include "apps/run/compare.hpp"

#include <algorithm>

#include "apps/run/ray_maker.hpp"
#include "common/interruption.hpp"
#include "geometry/model/world.hpp"
#include "runtime/processor_time.hpp"

namespace navjit::apps {
namespace {

/// What one of the two has done so far.
struct Side {
  RayMaker maker;
  double seconds = 0;
  std::uint64_t steps = 0;
};

}  // namespace

std::optional<Comparison> compare_with_generic(Runtime& specialised, const ObservedDetector& seen,
                                               const RuntimeOptions& options,
                                               const std::vector<Ray>& rays, double seconds,
                                               std::size_t basket) {
  RuntimeOptions off = options;
  off.jit = JitMode::off;
  off.cache = {};
  off.plugin = {};
  Runtime generic(specialised.share_world(), off);
  Side with{RayMaker(specialised, seen, basket)}, without{RayMaker(generic, seen, basket)};
  const double tolerance = specialised.world().tolerance;
  const auto make = [&](Side& side, std::uint64_t first, std::uint64_t last) {
    const double start = thread_seconds();
    const auto made = side.maker.make(std::span(rays).subspan(first, last - first), tolerance,
                                      [] { return common::interruption() == 0; });
    for (const RayTotals& totals : made) side.steps += totals.steps;
    side.seconds += thread_seconds() - start;
  };
  // What is met for the first time is slow, and with generic navigators all is: not counted.
  constexpr std::uint64_t first_rays = 8;
  for (Side* side : {&without, &with}) {
    make(*side, 0, std::min<std::uint64_t>(first_rays, rays.size()));
    side->seconds = 0;
    side->steps = 0;
  }
  // A detector may take longer to make than all the time that the rays are given.
  const double begun = thread_seconds();
  Comparison result;
  // Few rays at a time first, so that it ends in time where they are long. Then more: a turn has to
  // last long enough that it matters little what the other side left in caches and branch tables: a
  // run has one side alone.
  const double long_enough = std::min(0.01, seconds / 16);
  std::uint64_t turn = std::max<std::uint64_t>(first_rays, 4 * basket);
  bool with_first = true;
  while (result.rays < rays.size()) {
    const std::uint64_t last =
        result.rays + std::min<std::uint64_t>(turn, rays.size() - result.rays);
    const double before = with.seconds + without.seconds;
    // Whoever goes second finds the solids of these rays, which both share, in the caches.
    make(with_first ? with : without, result.rays, last);
    make(with_first ? without : with, result.rays, last);
    with_first = !with_first;
    if (common::interruption() != 0) return std::nullopt;
    result.rays = last;
    if (with.seconds + without.seconds - before < 2 * long_enough) turn *= 2;
    if (thread_seconds() - begun >= seconds) break;
  }
  if (with.steps == 0 || !(with.seconds > 0) || !(without.seconds > 0)) {
    return std::nullopt;
  }
  result.with = static_cast<double>(with.steps) / with.seconds;
  result.without = static_cast<double>(without.steps) / without.seconds;
  return result;
}

}  // namespace navjit::apps
