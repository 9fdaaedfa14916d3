// The rotations of a scene's daughters, stored with the scene's other numbers.
#pragma once

#include <array>
#include <map>

#include "codegen/data/arena.hpp"
#include "geometry/navigation/geometry.hpp"

namespace navjit::codegen {

/// Stores equal rotations once. Thousands of daughters have few different rotations. A rotation for
/// each daughter would mean to wait for two more cache lines whenever a ray is tested against one.
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
