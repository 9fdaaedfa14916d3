// <materials>: isotopes, elements, and materials with their elements by mass.
#pragma once

#include <string>
#include <vector>

#include "geometry/model/world.hpp"

namespace navjit::gdml {

struct WrittenMaterials {
  std::string text;
  std::vector<std::string> names;  ///< of each of the world's materials; empty where it has none
};

WrittenMaterials write_materials(const World& world);

}  // namespace navjit::gdml
