#include "codegen/data/rotations.hpp"

#include <algorithm>

namespace navjit::codegen {

const double* Rotations::of(const Daughter& d) {
  if (!d.transformation.rotated) return nullptr;
  std::array<double, 9> r;
  std::copy_n(d.transformation.rotation, 9, r.begin());
  const auto [at, fresh] = known_.try_emplace(r, nullptr);
  if (fresh) at->second = arena_.copy(std::span<const double>(r));
  return at->second;
}

}  // namespace navjit::codegen
