// ScenePlans in, the text of one module out: header-free C++ with the kernels it needs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "analysis/plan.hpp"
#include "codegen/data/arena.hpp"

namespace navjit::codegen {

/// The entry points of one volume in a module; extern "C" symbols. Equal volumes share
/// theirs; so do leaves that share code, each with data of its own.
struct Entry {
  VolumeId volume;
  std::string step;
  std::string relocate;
  std::string safety;  ///< empty where the scene has none of its own
  std::size_t at = 0;  ///< offset of its functions' data in the module's data
};

struct Module {
  std::string source;
  std::vector<Entry> entries;
  /// What the functions are handed as their data: tables of all scenes, which use the Geometry.
  const void* data = nullptr;
  std::shared_ptr<const Arena> owner;  ///< of the data

  const void* data_of(const Entry& entry) const {
    return static_cast<const std::byte*>(data) + entry.at;
  }
};

/// How many different solids the scene's code asks, its own and daughters'; the operands of
/// booleans are counted one by one.
std::size_t solids_of(const Geometry& geometry, const ScenePlan& plan);

/// Whether leaves of one kind in one mother share code (codegen/shared_leaves.hpp).
enum class Leaves : std::uint8_t {
  apart,   ///< faster where steps mostly end within them
  shared,  ///< faster where tracks go from one to the other
};

/// Generates navigators for `hot` volumes and all equal ones. Where tracks pass from one scene to
/// another, relocation is inlined: plans for mothers and daughters of hot scenes are made as
/// needed.
Module generate(const Geometry& geometry, const WorldFacts& facts, std::span<const VolumeId> hot,
                Leaves leaves = Leaves::apart);

}  // namespace navjit::codegen
