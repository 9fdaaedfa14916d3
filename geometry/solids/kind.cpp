#include "geometry/solids/solid.hpp"

namespace navjit {

const char* kind_name(SolidKind kind) {
  switch (kind) {
    case SolidKind::box:
      return "box";
    case SolidKind::tube:
      return "tube";
    case SolidKind::cone:
      return "cone";
    case SolidKind::trd:
      return "trd";
    case SolidKind::trap:
      return "trap";
    case SolidKind::orb:
      return "orb";
    case SolidKind::sphere:
      return "sphere";
    case SolidKind::polycone:
      return "polycone";
    case SolidKind::polyhedra:
      return "polyhedra";
    case SolidKind::placed:
      return "placed";
    case SolidKind::union_of:
      return "union";
    case SolidKind::intersection_of:
      return "intersection";
    case SolidKind::subtraction_of:
      return "subtraction";
  }
  return "unknown";
}

}  // namespace navjit
