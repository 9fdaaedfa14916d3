// Scenes that are waiting for the compiler. Private to runtime/.
#pragma once

#include <set>
#include <utility>
#include <vector>

#include "runtime/specialisation.hpp"

namespace navjit {

/// While this object exists its scenes have the status `compiling`. They keep this status if the
/// run ends first.
class Compiling {
 public:
  Compiling(Specialisation& spec, const std::set<VolumeId>& volumes);
  Compiling(const Compiling&) = delete;
  Compiling& operator=(const Compiling&) = delete;
  ~Compiling();

 private:
  Specialisation& spec_;
  std::vector<std::pair<VolumeId, SceneStatus>> before_{};
};

}  // namespace navjit
