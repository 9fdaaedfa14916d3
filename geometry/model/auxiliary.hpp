// Tags that a file attaches to volumes and placements for the program that reads it.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace navjit {

/// GDML's <auxiliary auxtype='...' auxvalue='...' auxunit='...'>; the texts are the file's.
struct Auxiliary {
  std::string type, value, unit;
  std::vector<Auxiliary> children{};
};

/// In the order of the file; null where there are none. Shared by copies of what has them.
using Auxiliaries = std::shared_ptr<const std::vector<Auxiliary>>;

}  // namespace navjit
