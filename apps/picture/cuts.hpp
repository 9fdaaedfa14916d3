// What is cut away of a detector, so that one sees into it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "navjit/vector.hpp"
#include "runtime/transport.hpp"

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

/// Of all cuts, in order, and none touches the next.
std::vector<Gap> gaps_of(const std::vector<Cut>& cuts, const Ray& ray);

/// How much of a way is not cut away, mm.
double left_of(const std::vector<Gap>& gaps, double from, double to);

/// Where a way first is not cut away; null `gap` if that is at its beginning.
struct FirstLeft {
  bool any = false;
  double at = 0;
  const Gap* gap = nullptr;  ///< the one that ends there
};
FirstLeft first_left(const std::vector<Gap>& gaps, double from, double to);

}  // namespace navjit::picture
