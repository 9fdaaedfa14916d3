#include "codegen/data/instances.hpp"

namespace navjit::codegen {

const kernels::DispatchEntry* bind_unrotated(const Geometry& geometry, const ScenePlan& plan,
                                             Arena& arena) {
  return detail::bind_mother<kernels::UnrotatedFrame>(geometry, plan, arena);
}

}  // namespace navjit::codegen
