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
    case SolidKind::hull:
      return "hull";
    case SolidKind::facets:
      return "facets";
    case SolidKind::prism:
      return "prism";
    case SolidKind::arb8:
      return "arb8";
    case SolidKind::cut_tube:
      return "cuttube";
    case SolidKind::scaled:
      return "scaled";
    case SolidKind::orb:
      return "orb";
    case SolidKind::sphere:
      return "sphere";
    case SolidKind::polycone:
      return "polycone";
    case SolidKind::polyhedra:
      return "polyhedra";
    case SolidKind::twistedtubs:
      return "twistedtubs";
    case SolidKind::twistedbox:
      return "twistedbox";
    case SolidKind::twistedtrd:
      return "twistedtrd";
    case SolidKind::twistedtrap:
      return "twistedtrap";
    case SolidKind::torus:
      return "torus";
    case SolidKind::ellipsoid:
      return "ellipsoid";
    case SolidKind::eltube:
      return "eltube";
    case SolidKind::elcone:
      return "elcone";
    case SolidKind::paraboloid:
      return "paraboloid";
    case SolidKind::hype:
      return "hype";
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
