#include "apps/accuracy/through.hpp"

#include <algorithm>

namespace navjit::accuracy {

Passing::Passing(const ObservedDetector& seen) : seen_(seen) {
  const Detector& detector = seen.detector();
  for (std::uint32_t m = 0; m < detector.materials(); ++m) {
    const double length = detector.material(m).radiation_length;
    rates_.push_back(length > 0 ? 1 / length : 0);
    parts_.push_back({{m, 1}});
  }
  for (const ObservationReport::Mixture& mixture : seen.report().mixtures) {
    std::vector<Part>& parts = parts_[mixture.number];
    parts.clear();
    for (const auto& part : mixture.parts) parts.push_back({part.material, part.share});
  }
}

void Passing::recorded_around(const State& state, std::vector<State>& touchables) const {
  touchables.clear();
  const Detector& original = seen_.original();
  const State at = seen_.original(state);
  const int depth = original.depth(at);
  for (int d = 0; d <= depth; ++d) {
    const State level = original.ancestor(at, d);
    if (recorded_[level.volume()]) touchables.push_back(level);
  }
}

Through Passing::through(Navigator& navigator, const Ray& ray, bool with_entries,
                         std::uint64_t& steps) const {
  const Detector& world = seen_.detector();
  Through sum{0, std::vector<double>(seen_.original().materials()), {}};
  ObservedNavigator observed(seen_, navigator);
  std::vector<State> before, now;
  double path = 0;
  transport(observed, ray, world.tolerance(), [&](const State& at, double length) {
    const std::uint32_t material = world.volume(at.volume()).material;
    if (material < rates_.size()) {
      sum.radiation_lengths += length * rates_[material];
      for (const Part& part : parts_[material]) sum.paths[part.material] += length * part.share;
    }
    if (with_entries && !recorded_.empty()) {
      recorded_around(at, now);
      for (const State& t : now) {
        if (std::find(before.begin(), before.end(), t) == before.end()) {
          sum.entries.push_back({t, path});
        }
      }
      std::swap(before, now);
    }
    path += length;
    ++steps;
  });
  return sum;
}

}  // namespace navjit::accuracy
