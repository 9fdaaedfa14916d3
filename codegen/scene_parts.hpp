// The parts of a scene whose navigator is generated: what of it becomes types and constants, and
// the tables that its code is handed.
#pragma once

#include <string>
#include <vector>

#include "codegen/data/parts.hpp"
#include "codegen/shapes.hpp"

namespace navjit::codegen {

/// What the numbers of a scene become in generated code.
enum class Numbers : std::uint8_t {
  constants,  ///< constants, but for large tables
  tables,     ///< all are in tables: the code is that of a structure
  own_solid,  ///< its solid and its frame are in tables, all else is constant: leaves that share
              ///< code
};

/// Daughters that are tested by the same code.
struct PartClass {
  enum class From : std::uint8_t { constant, box_in_table, shape_in_table };
  From from = From::constant;
  std::string type;  ///< of the solid
  bool rotated = false, box_first = false;
  bool apart = false;                  ///< its kernels are functions of their own
  std::vector<std::uint32_t> members;  ///< ascending
};

struct SceneParts {
  Numbers numbers = Numbers::constants;
  bool mother_in_table = false;
  bool mother_beside = false;  ///< its numbers are in the object itself
  bool listed = false;         ///< each daughter is a class, and none is in a table
  bool boxes_beside = false;   ///< some class has its boxes in the table of daughters
  std::vector<PartClass> classes;
};

/// Decides what of a scene is in types and constants, and what in tables. `shapes` spells the
/// types.
SceneParts parts_of_scene(const Geometry& geometry, const ScenePlan& plan, Numbers numbers,
                          Shapes& shapes);

/// The tables of a scene: an object of its Scene's layout, in which constants take no place. What
/// generated code asserts of it is beside.
struct SceneTables {
  const void* data = nullptr;
  std::size_t bytes = 0;
  std::size_t boxes = 0;  ///< offset of Scene::boxes
  /// The type of the search, and its constants as an initialiser; empty if it has none.
  std::string search_type, search_numbers;
};

SceneTables make_tables(const Source& source, const SceneParts& parts);

}  // namespace navjit::codegen
