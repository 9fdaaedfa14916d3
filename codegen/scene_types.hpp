// A scene as text: the types that its parts are, and the numbers that are constants. How it is
// navigated is the kernels' (geometry/kernels/scene.h).
#pragma once

#include <set>
#include <string>

#include "analysis/facts.hpp"
#include "codegen/scene_parts.hpp"

namespace navjit::codegen {

/// Volumes (each the first of its equals) whose relocation is in the same module and is called
/// directly.
struct Neighbours {
  std::set<VolumeId> enter;    ///< downward
  std::set<VolumeId> reenter;  ///< out of a daughter
};

/// The name of a volume's type.
std::string scene_name(VolumeId volume);

/// Definitions, in namespace navjit::kernels, of a type that is called `name`. `at`: where its
/// tables are in the data that the module is handed.
std::string scene_types(const Geometry& geometry, const WorldFacts& facts, const ScenePlan& plan,
                        const SceneParts& parts, const SceneTables& tables,
                        const Neighbours& neighbours, std::size_t at, const std::string& name,
                        Shapes& shapes);

}  // namespace navjit::codegen
