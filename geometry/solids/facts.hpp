// What the library knows of a solid in addition to its mathematics.
#pragma once

#include <array>
#include <optional>

#include "geometry/solids/gdml_words.hpp"
#include "geometry/solids/kernel_use.hpp"

namespace navjit {

/// For a solid that is round about its z axis, or nearly: the radii between which it is, mm, and
/// where it is cut along the axis.
struct Round {
  double near, far;
  kernels::Wedge<double> wedge{};
};

/// The facts of a shape, specialised in the solid's own header, with these members:
///
///   constexpr std::array kernel_files{...}    the kernels that its code is made of beside the
///                                             prelude, in the order in which they build on one
///                                             another, its own last
///   double volume(const Shape&)               mm^3; not of what is made of other solids
///
/// and, if there is something to say, these:
///
///   Round round(const Shape&)                 about its z axis: what patterns of daughters need
///   double ball(const Shape&)                 the radius of a ball about its origin that holds it
///   optional<double> error(const Shape&, const KernelUse&)
///                                             a bound of how far off a crossing may be, mm
///   constexpr std::array elements{...}        those of GDML whose numbers are all it takes
template <class Shape>
struct SolidFacts;

/// The name, in generated code, of the elements of shapes' arrays; specialised beside the facts.
template <class Element>
inline constexpr const char* element_name = nullptr;

}  // namespace navjit
