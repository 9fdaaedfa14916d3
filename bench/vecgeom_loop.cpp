#include "bench/vecgeom_loop.hpp"

#include "navjit/vecgeom.hpp"

namespace navjit::bench {

struct VecGeomLoop::Impl {
  vecgeom::Navigation navigation{{.runtime = {.jit = JitMode::wait}}};
};

VecGeomLoop::VecGeomLoop() : impl_(std::make_unique<Impl>()) {}
VecGeomLoop::~VecGeomLoop() = default;
void VecGeomLoop::attach() { impl_->navigation.attach(); }
Runtime& VecGeomLoop::runtime() { return impl_->navigation.runtime(); }

}  // namespace navjit::bench
