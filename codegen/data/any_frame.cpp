#include "codegen/data/instances.hpp"

namespace navjit::codegen {

const kernels::DispatchEntry* bind_any_frame(const Source& source) {
  return detail::bind_mother<kernels::AnyFrame>(source);
}

}  // namespace navjit::codegen
