// Solids moved and turned, and the booleans.
#pragma once

#include "geometry/solids/facts.hpp"
#include "navjit/solid_kind.hpp"

#include "geometry/kernels/boolean.h"
#include "geometry/kernels/boolean_paths.h"

namespace navjit {

/// Operands may be of any kind.
namespace kernels {
template <class Real>
using AnyPlaced = Placed<Real, AnySolid<Real>>;
template <class Real>
using AnyOperand = Boxed<Real, AnySolid<Real>>;
struct UnionParts;
/// A union of many parts has them as a set as well (any_union.hpp).
template <class Real>
struct AnyUnion {
  AnyOperand<Real> a, b;
  const UnionParts* parts = nullptr;  ///< the same parts; null: few, or not in double precision
};
template <class Real>
using AnyIntersection = Intersection<AnyOperand<Real>, AnyOperand<Real>>;
template <class Real>
using AnySubtraction = Subtraction<AnyOperand<Real>, AnyOperand<Real>>;
}  // namespace kernels

template <>
struct SolidFacts<kernels::AnyPlaced<double>> {
  static constexpr std::array kernel_files{"convex", "boolean", "boolean_paths"};
};

template <>
struct SolidFacts<kernels::AnyUnion<double>> {
  static constexpr std::array kernel_files{"convex", "boolean", "boolean_paths"};
};

template <>
struct SolidFacts<kernels::AnyIntersection<double>> {
  static constexpr std::array kernel_files{"convex", "boolean", "boolean_paths"};
};

template <>
struct SolidFacts<kernels::AnySubtraction<double>> {
  static constexpr std::array kernel_files{"convex", "boolean", "boolean_paths"};
};

}  // namespace navjit
