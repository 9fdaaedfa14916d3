// VecGeom's volumes navigated by navjit::vecgeom, without a header of VecGeom's.
#pragma once

#include <memory>

#include "navjit/runtime.hpp"

namespace navjit::bench {

/// Of the world that VecGeom has loaded, with every scene specialised. Has to be destroyed before
/// that world is.
class VecGeomLoop {
 public:
  VecGeomLoop();
  ~VecGeomLoop();

  /// Gives all volumes navjit's navigator, until another is set.
  void attach();
  Runtime& runtime();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace navjit::bench
