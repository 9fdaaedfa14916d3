// The parts of a scene for which code is generated: which of its numbers become types and
// constants, and the tables that the code is given.
#pragma once

#include <string>
#include <vector>

#include "codegen/data/parts.hpp"
#include "codegen/shapes.hpp"

namespace navjit::codegen {

/// What the numbers of a scene become in generated code.
enum class Numbers : std::uint8_t {
  constants,  ///< constants, except for large tables
  tables,     ///< tables: the code is that of a structure
  own_solid,  ///< the scene's solid and frame are in tables, and all else is constant; for leaves
              ///< that share code
};

/// Daughters that are tested by the same code.
struct PartClass {
  enum class From : std::uint8_t { constant, box_in_table, shape_in_table };
  From from = From::constant;
  std::string type;  ///< of the solid
  bool rotated = false, box_first = false;
  bool apart = false;                  ///< its kernels are not inlined
  std::vector<std::uint32_t> members;  ///< ascending
};

struct SceneParts {
  Numbers numbers = Numbers::constants;
  bool mother_in_table = false;
  bool mother_beside = false;  ///< the numbers of the scene's solid are in its own record
  bool listed = false;         ///< each daughter is a class, and no daughter is in a table
  bool boxes_beside = false;   ///< there is a class whose boxes are in the table of daughters
  std::vector<PartClass> classes;
};

/// Decides which numbers of a scene are in types and constants, and which are in tables. `shapes`
/// spells the types.
SceneParts parts_of_scene(const Geometry& geometry, const ScenePlan& plan, Numbers numbers,
                          Shapes& shapes);

/// The tables of a scene: an object that has the layout of its Scene, in which constants take no
/// space. The other members are what generated code states about it.
struct SceneTables {
  const void* data = nullptr;
  std::size_t bytes = 0;
  std::size_t boxes = 0;  ///< offset of Scene::boxes
  /// The type of the search, and its constants as an initialiser; empty if it has none.
  std::string search_type, search_numbers;
};

SceneTables make_tables(const Source& source, const SceneParts& parts);

}  // namespace navjit::codegen
