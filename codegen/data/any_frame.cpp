#include "codegen/data/instances.hpp"

namespace navjit::codegen {

const kernels::DispatchEntry* bind_any_frame(const Geometry& geometry, const ScenePlan& plan,
                                             Arena& arena) {
  return detail::bind_mother<kernels::AnyFrame>(geometry, plan, arena);
}

}  // namespace navjit::codegen
