// The rotations of a scene's daughters, beside its other numbers.
#pragma once

#include <array>
#include <map>

#include "codegen/data/arena.hpp"
#include "geometry/navigation/geometry.hpp"

namespace navjit::codegen {

/// Equal rotations are stored once: thousands of daughters have few different ones, and one for
/// each daughter would be two cache lines more to wait for at each that a ray is held against.
class Rotations {
 public:
  explicit Rotations(Arena& arena) : arena_(arena) {}

  /// The daughter's rotation, in the arena; null if it has none.
  const double* of(const Daughter& d);

 private:
  Arena& arena_;
  std::map<std::array<double, 9>, const double*> known_;
};

}  // namespace navjit::codegen
