// VecGeom's volumes navigated by navjit::vecgeom, with no header of VecGeom.
#pragma once

#include <memory>

#include "navjit/runtime.hpp"

namespace navjit::bench {

/// Takes the world that VecGeom has loaded, with every scene specialised. It has to be destroyed
/// before that world.
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
