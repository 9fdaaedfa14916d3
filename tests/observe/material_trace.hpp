// What a ray meets: materials and boundaries that count, and where they change.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/rays.hpp"
#include "navjit/observation.hpp"
#include "navjit/runtime.hpp"
#include "runtime/transport.hpp"

namespace navjit::tests {

/// A stretch of one material without a boundary that counts.
struct Stretch {
  VolumeId volume;  ///< of its first step
  double end;       ///< path along the ray, mm
};

/// The stretches of a ray, seen by a navigator of the original (`every` boundary) or of what is
/// left of it. Stretches shorter than `least` are left out: which of two faces at the same place
/// comes first is decided by the last bit.
template <class AnyNavigator>
std::vector<Stretch> stretches(AnyNavigator& navigator, const ObservedDetector& seen,
                               const Ray& ray, double least) {
  std::vector<Stretch> all;
  double path = 0;
  const RayTotals made =
      transport(navigator, ray, seen.original().tolerance(), [&](const State& at, double length) {
        path += length;
        if (length < least) return;
        if (all.empty() || seen.counts(all.back().volume, at.volume())) {
          all.push_back({at.volume(), path});
        }
        all.back().end = path;
      });
  EXPECT_FALSE(made.stuck);
  return all;
}

struct Compared {
  std::size_t rays = 0, stretches = 0, different = 0;
  double largest = 0;  ///< how far apart a change of material is in both, mm
};

/// Compares rays through the original, with every boundary, and through what is left of it.
inline Compared compare(const ObservedDetector& seen, const std::vector<Ray>& rays,
                        JitMode jit = JitMode::off) {
  RuntimeOptions options;
  options.jit = jit;
  options.specialiser.constants = options.specialiser.structures = false;
  options.specialiser.solids = false;  // bound to data: at once
  Runtime whole(seen.original(), {.jit = JitMode::off}), less(seen.detector(), options);
  Navigator every = whole.navigator(), left = less.navigator();
  ObservedNavigator observed(seen, left);
  const double least = 1e-7;
  Compared result;
  for (const Ray& ray : rays) {
    const auto a = stretches(every, seen, ray, least), b = stretches(observed, seen, ray, least);
    ++result.rays;
    bool same = a.size() == b.size();
    for (std::size_t i = 0; same && i < a.size(); ++i) {
      same = !seen.counts(a[i].volume, b[i].volume) || a[i].volume == b[i].volume;
      result.largest = std::max(result.largest, std::abs(a[i].end - b[i].end));
      ++result.stretches;
    }
    if (!same) ++result.different;
  }
  return result;
}

/// Radiation lengths along a ray.
template <class AnyNavigator>
double radiation_lengths(AnyNavigator& navigator, const Detector& detector, const Ray& ray) {
  double sum = 0;
  transport(navigator, ray, detector.tolerance(), [&](const State& at, double length) {
    const double x0 = detector.material(detector.volume(at.volume())).radiation_length;
    if (x0 > 0) sum += length / x0;
  });
  return sum;
}

inline std::vector<Ray> aimed_rays(const Detector& detector, std::uint64_t count,
                                   std::uint64_t seed = 1) {
  const common::RayMaker maker(*detector.model(), {.seed = seed, .aim = "auto"});
  std::vector<Ray> rays;
  for (std::uint64_t i = 0; i < count; ++i) rays.push_back(maker.ray(i));
  return rays;
}

}  // namespace navjit::tests
