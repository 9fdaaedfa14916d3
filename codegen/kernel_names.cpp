#include "codegen/kernel_names.hpp"

#include <algorithm>
#include <array>

namespace navjit::codegen {
namespace {

constexpr std::array order{
    "convex", "box",      "trd",          "trap",         "wedge", "tube",    "cone",   "orb",
    "sphere", "sections", "polycone",     "polyhedra",    "hull",  "facets",  "pairs",  "prism",
    "torus",  "quadric",  "twisted_tube", "twisted_trap", "arb8",  "cuttube", "scaled", "boolean"};
constexpr std::array box{"convex", "box"};
constexpr std::array trd{"convex", "trd"};
constexpr std::array trap{"convex", "trap"};
constexpr std::array hull{"convex", "trap", "hull"};
constexpr std::array facets{"convex", "facets"};
constexpr std::array prism{"convex", "facets", "pairs", "prism"};
constexpr std::array arb8{"convex", "pairs", "quadric", "arb8"};
constexpr std::array cut_tube{"convex", "trap", "wedge", "tube", "cuttube"};
constexpr std::array scaled{"convex", "scaled"};
constexpr std::array tube{"convex", "wedge", "tube"};
constexpr std::array cone{"convex", "wedge", "tube", "cone"};
constexpr std::array orb{"convex", "wedge", "tube", "cone", "orb"};
constexpr std::array sphere{"convex", "wedge", "tube", "cone", "orb", "sphere"};
constexpr std::array polycone{"convex", "wedge", "tube", "cone", "sections", "polycone"};
constexpr std::array polyhedra{"convex",   "wedge",    "tube",     "cone",
                               "sections", "polycone", "polyhedra"};
constexpr std::array torus{"convex", "wedge", "pairs", "torus"};
constexpr std::array quadric{"convex", "pairs", "quadric"};
constexpr std::array twisted_tube{"convex", "pairs", "quadric", "twisted_tube"};
constexpr std::array twisted_trap{"convex", "pairs", "twisted_trap"};
constexpr std::array boolean{"convex", "boolean"};

constexpr std::array of_scenes{"apart",      "grid",      "boxes",
                               "four_boxes", "slabs",     "nest",
                               "rings",      "wires",     "navigation_stack",
                               "navigation", "frames",    "bound_solids",
                               "constants",  "daughters", "classes",
                               "search_few", "searches",  "constant_searches"};

}  // namespace

std::span<const char* const> scene_kernels() { return of_scenes; }

std::span<const char* const> kernels_of(SolidKind kind) {
  switch (kind) {
    case SolidKind::box:
      return box;
    case SolidKind::tube:
      return tube;
    case SolidKind::cone:
      return cone;
    case SolidKind::trd:
      return trd;
    case SolidKind::trap:
      return trap;
    case SolidKind::hull:
      return hull;
    case SolidKind::facets:
      return facets;
    case SolidKind::prism:
      return prism;
    case SolidKind::arb8:
      return arb8;
    case SolidKind::cut_tube:
      return cut_tube;
    case SolidKind::scaled:
      return scaled;
    case SolidKind::orb:
      return orb;
    case SolidKind::sphere:
      return sphere;
    case SolidKind::polycone:
      return polycone;
    case SolidKind::polyhedra:
      return polyhedra;
    case SolidKind::twistedtubs:
      return twisted_tube;
    case SolidKind::twistedbox:
    case SolidKind::twistedtrd:
    case SolidKind::twistedtrap:
      return twisted_trap;
    case SolidKind::torus:
      return torus;
    case SolidKind::ellipsoid:
    case SolidKind::eltube:
    case SolidKind::elcone:
    case SolidKind::paraboloid:
    case SolidKind::hype:
      return quadric;
    case SolidKind::placed:
    case SolidKind::union_of:
    case SolidKind::intersection_of:
    case SolidKind::subtraction_of:
      return boolean;
  }
  return {};
}

std::string shape_type(SolidKind kind) {
  switch (kind) {
    case SolidKind::box:
      return "Box<double>";
    case SolidKind::tube:
      return "Tube<double>";
    case SolidKind::cone:
      return "Cone<double>";
    case SolidKind::trd:
      return "Trd<double>";
    case SolidKind::trap:
      return "Trap<double>";
    case SolidKind::hull:
      return "Hull<double>";
    case SolidKind::facets:
      return "Facets<double>";
    case SolidKind::prism:
      return "Prism<double>";
    case SolidKind::arb8:
      return "Arb8<double>";
    case SolidKind::cut_tube:
      return "CutTube<double>";
    case SolidKind::orb:
      return "Orb<double>";
    case SolidKind::sphere:
      return "Sphere<double>";
    case SolidKind::polycone:
      return "Polycone<double>";
    case SolidKind::polyhedra:
      return "Polyhedra<double>";
    case SolidKind::twistedtubs:
      return "TwistedTube<double>";
    case SolidKind::twistedbox:
    case SolidKind::twistedtrd:
    case SolidKind::twistedtrap:
      return "TwistedTrap<double>";
    case SolidKind::torus:
      return "Torus<double>";
    case SolidKind::ellipsoid:
    case SolidKind::eltube:
    case SolidKind::elcone:
    case SolidKind::paraboloid:
    case SolidKind::hype:
      return "QuadricSolid<double>";
    case SolidKind::scaled:
    case SolidKind::placed:
    case SolidKind::union_of:
    case SolidKind::intersection_of:
    case SolidKind::subtraction_of:
      break;
  }
  return {};
}

std::span<const char* const> kernel_order() { return order; }

bool inlines_everywhere(std::string_view kernel) {
  constexpr std::array<std::string_view, 9> small{"convex",  "box",   "trd",  "trap", "cone",
                                                  "boolean", "wedge", "tube", "orb"};
  return std::find(small.begin(), small.end(), kernel) != small.end();
}

}  // namespace navjit::codegen
