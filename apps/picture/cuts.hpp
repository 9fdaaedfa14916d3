// What is cut away of a detector, so that one sees into it.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "common/passage.hpp"

namespace navjit::picture {

/// Points p with normal * p > offset; the normal is of unit length, offset in mm.
struct HalfSpace {
  Vec3 normal{1, 0, 0};
  double offset = 0;
};

/// What is in all of the half-spaces is cut away.
using Cut = std::vector<HalfSpace>;

/// "x>0": what is there is cut away; "x>0,y>10": what is in both. Throws UsageError.
Cut parse_cut(std::string_view text);

/// A part of a ray that is cut away.
struct Gap {
  double from, to;  ///< way from the start of the ray, mm
  Vec3 face;        ///< unit normal of the plane at its end, out of what is left there
};

/// The gaps of all cuts along the ray, in order; none touches the next.
std::vector<Gap> gaps_of(const std::vector<Cut>& cuts, const Ray& ray);

/// As common::pass(), but what is cut away is jumped over: `sink(leg, face)` gets the parts of legs
/// that are left, with ways from the start of the ray; `face` is the normal of the plane that a
/// part begins on, or null where none is cut.
template <class AnyNavigator, class Sink>
common::PassageEnd pass_uncut(AnyNavigator& navigator, const World& world, const Ray& ray,
                              const std::vector<Gap>& gaps, Sink&& sink) {
  double start = 0;
  for (std::size_t next = 0;;) {
    const Vec3* face = nullptr;
    if (next < gaps.size() && gaps[next].from <= start) {
      start = gaps[next].to;
      if (!std::isfinite(start)) return common::PassageEnd::left;
      face = &gaps[next++].face;
    }
    const double end =
        next < gaps.size() ? gaps[next].from : std::numeric_limits<double>::infinity();
    bool at_end = false;
    const Ray part{ray.position + start * ray.direction, ray.direction};
    const auto how = common::pass(navigator, world, part, [&](common::Leg leg) {
      const Vec3* const begins_on = leg.from == 0 ? face : nullptr;
      leg.from += start;
      leg.to += start;
      at_end = leg.to >= end;
      leg.to = std::min(leg.to, end);
      if (leg.from < end && !sink(leg, begins_on)) {
        at_end = false;
        return false;
      }
      return !at_end;
    });
    if (how != common::PassageEnd::stopped || !at_end) return how;
    start = end;
  }
}

}  // namespace navjit::picture
