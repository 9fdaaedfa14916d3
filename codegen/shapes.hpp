// Solids as C++: their types, their constants, and the kernels that they need.
#pragma once

#include <map>
#include <set>
#include <string>

#include "codegen/typed_solid.hpp"
#include "geometry/solids/solid.hpp"

namespace navjit::codegen {

/// Collects the constants of a module's solids; equal shapes are written once.
class Shapes {
 public:
  Shapes() = default;
  /// `alone`: the solids get functions of their own and are not parts of a scene (apart_in()).
  explicit Shapes(bool alone) : alone_(alone) {}

  /// The name of a constant that holds the shape; defines it on first use.
  std::string constant(const kernels::AnySolid<double>& solid);
  /// The type of a solid, in namespace navjit::kernels.
  std::string type(const kernels::AnySolid<double>& solid);
  /// The definitions so far, in order of use.
  const std::string& definitions() const { return definitions_; }
  /// Names of the kernel files that the shapes need.
  const std::set<std::string>& kernels() const { return kernels_; }

 private:
  void need(SolidKind kind);
  void begin(const kernels::AnySolid<double>& solid);
  std::string type_of(const kernels::AnySolid<double>& solid);
  std::string literal(const kernels::AnySolid<double>& solid);
  std::string operand_literal(const kernels::AnyOperand<double>& operand);

  std::map<std::string, std::string> constants_;    ///< name by solid_key
  std::set<std::string> kernels_{"convex", "box"};  ///< boxes are in the tables of daughters
  std::string definitions_;
  int arrays_ = 0;
  bool alone_ = false;
  Apart apart_ = Apart::large;  ///< for the solid that is being written
};

}  // namespace navjit::codegen
