// Sets of boxes to search, made up or from a detector.
#pragma once

#include <string>
#include <vector>

#include "geometry/solids/solid.hpp"

namespace navjit::bench {

struct BoxScene {
  std::string name;
  std::vector<Extent> boxes;
};

/// `count` boxes in a cube of 1000 mm: cubes of a grid with gaps ("grid", sparse candidates),
/// plates of a stack ("stack", a ray meets them all), and boxes of edges from 0.1% to 30% of the
/// cube at random ("mixed", they overlap).
std::vector<BoxScene> made_up_scenes(std::size_t count);

/// The daughters' boxes of the `most` volumes with most daughters, four at least, in a GDML file.
/// Throws GdmlError.
std::vector<BoxScene> scenes_of(const std::string& file, std::size_t most);

/// Around all boxes, as far as they are finite.
Extent bounds(const std::vector<Extent>& boxes);

}  // namespace navjit::bench
