// What is known of each kind of solid.
#pragma once

#include <span>

#include "geometry/solids/list.hpp"

namespace navjit {

struct KindFacts {
  SolidKind kind;
  const char* name;                              ///< in output
  const char* shape;                             ///< in generated code; not if made of other solids
  std::span<const char* const> kernel_files;     ///< SolidFacts::kernel_files
  std::span<const gdml::SolidElement> elements;  ///< SolidFacts::elements
};

/// The facts of all kinds, in the order of the list.
std::span<const KindFacts> all_kinds();
const KindFacts& facts_of(SolidKind kind);

}  // namespace navjit
