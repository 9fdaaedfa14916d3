#include "codegen/data/instances.hpp"

namespace navjit::codegen {

const kernels::DispatchEntry* bind_turned(const Geometry& geometry, const ScenePlan& plan,
                                          Arena& arena) {
  return detail::bind_mother<kernels::TurnedFrame>(geometry, plan, arena);
}

}  // namespace navjit::codegen
