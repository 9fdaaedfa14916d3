#include "geometry/solids/kinds.hpp"

#include "navjit/solids.hpp"

namespace navjit {
namespace {

template <class Shape>
constexpr std::span<const gdml::SolidElement> elements_of() {
  if constexpr (requires { SolidFacts<Shape>::elements; }) return SolidFacts<Shape>::elements;
  return {};
}

constexpr KindFacts kinds[] = {
#define NAVJIT_ROW(kind, name, Shape)                                                          \
  {SolidKind::kind, name, #Shape "<double>", SolidFacts<kernels::Shape<double>>::kernel_files, \
   elements_of<kernels::Shape<double>>()},
    NAVJIT_SOLIDS(NAVJIT_ROW, NAVJIT_ROW)
#undef NAVJIT_ROW
};

}  // namespace

std::span<const KindFacts> all_kinds() { return kinds; }

const KindFacts& facts_of(SolidKind kind) {
  for (const KindFacts& facts : kinds) {
    if (facts.kind == kind) return facts;
  }
  __builtin_unreachable();
}

const char* kind_name(SolidKind kind) {
  for (const KindFacts& facts : kinds) {
    if (facts.kind == kind) return facts.name;
  }
  return "unknown";
}

}  // namespace navjit
