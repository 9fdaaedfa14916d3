// The list of all solids. A new solid needs two lines here, one in each list.
#pragma once

#include "geometry/solids/any_union.hpp"
#include "geometry/solids/arb8.hpp"
#include "geometry/solids/boolean.hpp"
#include "geometry/solids/box.hpp"
#include "geometry/solids/cone.hpp"
#include "geometry/solids/cuttube.hpp"
#include "geometry/solids/facets.hpp"
#include "geometry/solids/foreign.hpp"
#include "geometry/solids/hull.hpp"
#include "geometry/solids/orb.hpp"
#include "geometry/solids/polycone.hpp"
#include "geometry/solids/polyhedra.hpp"
#include "geometry/solids/prism.hpp"
#include "geometry/solids/quadric.hpp"
#include "geometry/solids/scaled.hpp"
#include "geometry/solids/sphere.hpp"
#include "geometry/solids/torus.hpp"
#include "geometry/solids/trap.hpp"
#include "geometry/solids/trd.hpp"
#include "geometry/solids/tube.hpp"
#include "geometry/solids/twisted_trap.hpp"
#include "geometry/solids/twisted_tube.hpp"

// Kind, name in output, and shape in namespace kernels. ALSO is another kind with the shape of the
// line below it. Generated code has the kernels in the order in which they are first needed here.
// clang-format off
#define NAVJIT_SOLIDS(SOLID, ALSO)                        \
  SOLID(box, "box", Box)                                  \
  SOLID(trd, "trd", Trd)                                  \
  SOLID(trap, "trap", Trap)                               \
  SOLID(tube, "tube", Tube)                               \
  SOLID(cone, "cone", Cone)                               \
  SOLID(orb, "orb", Orb)                                  \
  SOLID(sphere, "sphere", Sphere)                         \
  SOLID(polycone, "polycone", Polycone)                   \
  SOLID(polyhedra, "polyhedra", Polyhedra)                \
  SOLID(hull, "hull", Hull)                               \
  SOLID(facets, "facets", Facets)                         \
  SOLID(prism, "prism", Prism)                            \
  SOLID(torus, "torus", Torus)                            \
  ALSO(ellipsoid, "ellipsoid", QuadricSolid)              \
  ALSO(eltube, "eltube", QuadricSolid)                    \
  ALSO(elcone, "elcone", QuadricSolid)                    \
  ALSO(paraboloid, "paraboloid", QuadricSolid)            \
  SOLID(hype, "hype", QuadricSolid)                       \
  SOLID(twistedtubs, "twistedtubs", TwistedTube)          \
  ALSO(twistedbox, "twistedbox", TwistedTrap)             \
  ALSO(twistedtrd, "twistedtrd", TwistedTrap)             \
  SOLID(twistedtrap, "twistedtrap", TwistedTrap)          \
  SOLID(arb8, "arb8", Arb8)                               \
  SOLID(cut_tube, "cuttube", CutTube)                     \
  SOLID(scaled, "scaled", AnyScaled)                      \
  SOLID(placed, "placed", AnyPlaced)                      \
  SOLID(union_of, "union", AnyUnion)                      \
  SOLID(intersection_of, "intersection", AnyIntersection) \
  SOLID(subtraction_of, "subtraction", AnySubtraction)    \
  SOLID(foreign, "foreign", Foreign)
// clang-format on
