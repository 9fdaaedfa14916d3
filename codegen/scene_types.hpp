// A scene as text: the types of its parts, and the numbers that are constants. How it is navigated
// is defined by geometry/kernels/scene.h.
#pragma once

#include <set>
#include <string>

#include "analysis/facts.hpp"
#include "codegen/scene_parts.hpp"

namespace navjit::codegen {

/// Volumes whose relocation is in the same module and is called directly. Each is the first of its
/// equals.
struct Neighbours {
  std::set<VolumeId> enter;    ///< into them, from a mother
  std::set<VolumeId> reenter;  ///< back into them, out of a daughter
};

/// The name of a volume's type.
std::string scene_name(VolumeId volume);

/// The definition, in namespace navjit::kernels, of a type with the given name. `at` is the offset
/// of the scene's tables in the module's data.
std::string scene_types(const Geometry& geometry, const WorldFacts& facts, const ScenePlan& plan,
                        const SceneParts& parts, const SceneTables& tables,
                        const Neighbours& neighbours, std::size_t at, const std::string& name,
                        Shapes& shapes);

}  // namespace navjit::codegen
