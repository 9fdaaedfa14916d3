// Solids moved and turned, and the booleans.
#pragma once

#include "geometry/solids/facts.hpp"
#include "navjit/solid_kind.hpp"

#include "geometry/kernels/boolean.h"

namespace navjit {

/// Operands are of any kind.
namespace kernels {
template <class Real>
using AnyPlaced = Placed<Real, AnySolid<Real>>;
template <class Real>
using AnyOperand = Boxed<Real, AnySolid<Real>>;
template <class Real>
using AnyUnion = Union<AnyOperand<Real>, AnyOperand<Real>>;
template <class Real>
using AnyIntersection = Intersection<AnyOperand<Real>, AnyOperand<Real>>;
template <class Real>
using AnySubtraction = Subtraction<AnyOperand<Real>, AnyOperand<Real>>;
}  // namespace kernels

template <>
struct SolidFacts<kernels::AnyPlaced<double>> {
  static constexpr std::array kernel_files{"convex", "boolean"};
};

template <>
struct SolidFacts<kernels::AnyUnion<double>> {
  static constexpr std::array kernel_files{"convex", "boolean"};
};

template <>
struct SolidFacts<kernels::AnyIntersection<double>> {
  static constexpr std::array kernel_files{"convex", "boolean"};
};

template <>
struct SolidFacts<kernels::AnySubtraction<double>> {
  static constexpr std::array kernel_files{"convex", "boolean"};
};

}  // namespace navjit
