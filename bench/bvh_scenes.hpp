// Sets of boxes to search, random or from a detector.
#pragma once

#include <string>
#include <vector>

#include "geometry/solids/solid.hpp"

namespace navjit::bench {

struct BoxScene {
  std::string name;
  std::vector<Extent> boxes;
};

/// `count` boxes in a cube of 1000 mm: cubes of a grid with gaps ("grid", few candidates), plates
/// of a stack ("stack", a ray meets all of them), or random boxes with edges from 0.1% to 30% of
/// the cube ("mixed", they overlap).
std::vector<BoxScene> made_up_scenes(std::size_t count);

/// The boxes of the daughters of the `most` volumes in a GDML file that have the most daughters,
/// four at least. Throws GdmlError.
std::vector<BoxScene> scenes_of(const std::string& file, std::size_t most);

/// The box around all boxes, where these are finite.
Extent bounds(const std::vector<Extent>& boxes);

}  // namespace navjit::bench
