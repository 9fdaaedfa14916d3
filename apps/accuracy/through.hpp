// What a ray goes through, seen by one way of observing: enough to compare it with another.
#pragma once

#include <vector>

#include "navjit/observation.hpp"
#include "runtime/transport.hpp"

namespace navjit::accuracy {

/// Where a ray comes into a volume that is observed by itself.
struct Entry {
  State state;  ///< of the original
  double path;  ///< along the ray, mm
};

struct Through {
  double radiation_lengths = 0;
  /// By material of the original, mm. In a mixture by the volumes of its parts: what the path in
  /// each would be in the mean.
  std::vector<double> paths;
  std::vector<Entry> entries;
};

/// What of a detector is needed to find what rays go through.
class Passing {
 public:
  explicit Passing(const ObservedDetector& seen);

  /// Says by volume whether entries into it are recorded; none are before this is called.
  void record_entries(std::vector<bool> volumes) { recorded_ = std::move(volumes); }

  /// By a navigator of seen.detector(). `steps` grows by what the run would see.
  Through through(Navigator& navigator, const Ray& ray, bool with_entries,
                  std::uint64_t& steps) const;

 private:
  /// Touchables of the original that hold a state of the simplified one and are recorded.
  void recorded_around(const State& state, std::vector<State>& touchables) const;

  const ObservedDetector& seen_;
  struct Part {
    std::uint32_t material;
    double share;
  };
  std::vector<std::vector<Part>> parts_;  ///< by material of the simplified detector
  std::vector<double> rates_;             ///< by material, 1/mm
  std::vector<bool> recorded_;            ///< by volume; empty: none
};

}  // namespace navjit::accuracy
