// The kernels of normals, and their dispatch. Apart from the other kernels, since no navigator
// needs them.
#pragma once

#include "geometry/solids/any_solid.hpp"

// clang-format off
#include "geometry/kernels/normal.h"
#include "geometry/kernels/normal_curved.h"
#include "geometry/kernels/normal_boolean.h"
// clang-format on

namespace navjit::kernels {

template <class Real>
Vec3<Real> normal(const AnySolid<Real>& s, const Vec3<Real>& p, Real tol) {
  return visit(s, [&](const auto& shape) { return normal(shape, p, tol); });
}

}  // namespace navjit::kernels
