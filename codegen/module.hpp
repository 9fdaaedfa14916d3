// Generates the text of a module from the plans of scenes. It is C++ without includes, with the
// kernels that it needs.
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

/// The entry points of one volume in a module, which are extern "C" symbols. Equal volumes share
/// theirs. So do leaves that share code, each of which has data of its own.
struct Entry {
  VolumeId volume;
  std::string step;
  std::string relocate;
  std::string safety;  ///< empty if the scene has no code for it
  std::size_t at = 0;  ///< offset of its functions' data in the module's data
};

struct Module {
  std::string source;
  std::vector<Entry> entries;
  /// The data that the functions are given: the tables of all scenes. They refer to the Geometry.
  const void* data = nullptr;
  std::shared_ptr<const Arena> owner;  ///< of the data

  const void* data_of(const Entry& entry) const {
    return static_cast<const std::byte*>(data) + entry.at;
  }
};

/// How many different solids the code of the scene asks: its own and the daughters'. The operands
/// of booleans are counted one by one.
std::size_t solids_of(const Geometry& geometry, const ScenePlan& plan);

/// Whether leaves of one kind in one mother share code (codegen/shared_leaves.hpp).
enum class Leaves : std::uint8_t {
  apart,   ///< faster if most steps end within them
  shared,  ///< faster if tracks go from one to the other
};

/// Generates navigators for the `hot` volumes and all volumes equal to them. Where tracks pass from
/// one scene to another, relocation is inlined. For this, the mothers and daughters of hot scenes
/// are planned as well.
Module generate(const Geometry& geometry, const WorldFacts& facts, std::span<const VolumeId> hot,
                Leaves leaves = Leaves::apart);

}  // namespace navjit::codegen
