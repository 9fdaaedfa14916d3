// The rotations of a scene's daughters, beside its other numbers.
#pragma once

#include <array>
#include <map>

#include "codegen/data/arena.hpp"
#include "geometry/navigation/geometry.hpp"

namespace navjit::codegen {

/// Equal ones are kept once: of thousands of daughters few have one of their own, and each that a
/// ray is held against would be two cache lines more to wait for.
class Rotations {
 public:
  explicit Rotations(Arena& arena) : arena_(arena) {}

  /// Of the daughter, in the arena; null if it has none.
  const double* of(const Daughter& d);

 private:
  Arena& arena_;
  std::map<std::array<double, 9>, const double*> known_;
};

}  // namespace navjit::codegen
