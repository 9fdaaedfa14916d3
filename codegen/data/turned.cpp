#include "codegen/data/instances.hpp"

namespace navjit::codegen {

const kernels::DispatchEntry* bind_turned(const Source& source) {
  return detail::bind_mother<kernels::TurnedFrame>(source);
}

}  // namespace navjit::codegen
