// What an engine made of rays: the raw material of the comparison with the reference.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/transport.hpp"

namespace navjit::accuracy {

/// One step as an engine made it.
struct MadeStep {
  Vec3 point;                            ///< start, global, mm
  double length;                         ///< mm
  std::string volume;                    ///< logical volume claimed
  std::optional<TouchableId> touchable;  ///< claimed; engines that are not ours tell volumes alone
};

/// One ray as an engine carried it, until it left the world or was given up.
struct MadeRay {
  std::size_t index = 0;  ///< among the rays transported
  std::vector<MadeStep> steps;
  Vec3 end{0, 0, 0};  ///< where the engine had the ray when it left the world or gave up
  bool stuck = false;
};

}  // namespace navjit::accuracy
