// A long track: straight legs from point to point within the world, as physics would make them. The
// directions and lengths of all legs are given, so where the track ends is known exactly, and how
// far an engine has drifted from there is what its steps' rounding added up to.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/reference/wide_geometry.hpp"
#include "navjit/navigator.hpp"

namespace navjit::accuracy {

struct Leg {
  Vec3 direction;
  double length;  ///< mm
};

struct Track {
  Vec3 start{0, 0, 0};
  std::vector<Leg> legs;
};

/// A track on which the navigator crosses at least so many boundaries, unless `most_legs` come
/// before.
Track make_track(const reference::WideGeometry& reference, Navigator& navigator,
                 std::uint64_t boundaries, std::uint64_t seed, std::size_t most_legs = 200000);

/// Where an engine was after a leg.
struct LegEnd {
  Vec3 point;
  std::uint64_t boundaries;  ///< crossed since the start
};

struct TrackResult {
  std::uint64_t boundaries = 0;
  double drift = 0;       ///< at the end, mm
  double largest = 0;     ///< after any leg, mm
  double ulp = 1;         ///< last bit of the world's largest coordinate, mm
  bool complete = false;  ///< false: stuck or lost on the way
};

/// Carries a track through the world, until its end, or until it is stuck or lost.
std::vector<LegEnd> follow(Navigator& navigator, const World& world, const Track& track);

/// Holds the ends of legs against where they are exactly.
TrackResult judge_track(const World& world, const Track& track, const std::vector<LegEnd>& ends);

}  // namespace navjit::accuracy
