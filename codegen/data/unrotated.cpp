#include "codegen/data/instances.hpp"

namespace navjit::codegen {

const kernels::DispatchEntry* bind_unrotated(const Source& source) {
  return detail::bind_mother<kernels::UnrotatedFrame>(source);
}

}  // namespace navjit::codegen
