// Solids stretched along the axes.
#pragma once

#include "geometry/solids/facts.hpp"
#include "navjit/solid_kind.hpp"

#include "geometry/kernels/scaled.h"

namespace navjit {

/// The solids that are scaled may be of any kind.
namespace kernels {
template <class Real>
using AnyScaled = Scaled<Real, AnySolid<Real>>;
}  // namespace kernels

template <>
struct SolidFacts<kernels::AnyScaled<double>> {
  static constexpr std::array kernel_files{"convex", "scaled"};
};

}  // namespace navjit
