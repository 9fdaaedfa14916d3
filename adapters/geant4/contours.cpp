// Converts solids that are given by polygons, planes or facets.
#include <G4ExtrudedSolid.hh>
#include <G4GenericPolycone.hh>
#include <G4GenericTrap.hh>
#include <G4Polycone.hh>
#include <G4Polyhedra.hh>
#include <G4TessellatedSolid.hh>
#include <G4Tet.hh>
#include <array>
#include <cmath>
#include <typeinfo>

#include "adapters/geant4/solids.hpp"
#include "adapters/geant4/vector.hpp"

namespace navjit::geant4 {
namespace {

template <typename S>
std::vector<ContourPoint> corners(const S& solid) {
  std::vector<ContourPoint> points;
  for (G4int i = 0; i < solid.GetNumRZCorner(); ++i) {
    points.push_back({solid.GetCorner(i).r, solid.GetCorner(i).z});
  }
  return points;
}

/// The planes that the user gave; `factor` converts their radii to navjit's.
template <typename Historical>
std::vector<ZPlane> planes(const Historical& given, double factor) {
  std::vector<ZPlane> planes;
  for (G4int i = 0; i < given.Num_z_planes; ++i) {
    planes.push_back({given.Z_values[i], given.Rmin[i] * factor, given.Rmax[i] * factor});
  }
  return planes;
}

Solid polycone(const G4Polycone& s) {
  const G4PolyconeHistorical* given = s.GetOriginalParameters();
  if (given != nullptr && given->Num_z_planes > 0) {
    return make_polycone(s.GetName(), planes(*given, 1), given->Start_angle, given->Opening_angle);
  }
  return make_generic_polycone(s.GetName(), corners(s), s.GetStartPhi(),
                               s.GetEndPhi() - s.GetStartPhi());
}

Solid polyhedra(const G4Polyhedra& s) {
  const G4PolyhedraHistorical* given = s.GetOriginalParameters();
  if (!s.IsGeneric() && given != nullptr && given->Num_z_planes > 0) {
    // Geant4 holds the radii of the edges, and navjit those of the sides.
    const double factor = std::cos(given->Opening_angle / given->numSide / 2);
    return make_polyhedra(s.GetName(), planes(*given, factor), given->numSide, given->Start_angle,
                          given->Opening_angle);
  }
  return make_generic_polyhedra(s.GetName(), corners(s), s.GetNumSide(), s.GetStartPhi(),
                                s.GetEndPhi() - s.GetStartPhi());
}

Solid extruded(const G4ExtrudedSolid& s) {
  std::vector<PlanarPoint> polygon;
  for (const G4TwoVector& corner : s.GetPolygon()) polygon.push_back({corner.x(), corner.y()});
  std::vector<ExtrudedSection> sections;
  for (const G4ExtrudedSolid::ZSection& section : s.GetZSections()) {
    sections.push_back({section.fZ, section.fOffset.x(), section.fOffset.y(), section.fScale});
  }
  return make_extruded(s.GetName(), polygon, sections);
}

Solid tessellated(const G4TessellatedSolid& s) {
  std::vector<FacetCorners> facets;
  for (G4int i = 0; i < s.GetNumberOfFacets(); ++i) {
    const G4VFacet& facet = *s.GetFacet(i);
    FacetCorners corners;
    for (G4int j = 0; j < facet.GetNumberOfVertices(); ++j) {
      corners.push_back(vector(facet.GetVertex(j)));
    }
    facets.push_back(std::move(corners));
  }
  return make_tessellated(s.GetName(), facets);
}

Solid tet(const G4Tet& s) {
  const std::vector<G4ThreeVector> corners = s.GetVertices();
  return make_tet(s.GetName(), vector(corners[0]), vector(corners[1]), vector(corners[2]),
                  vector(corners[3]));
}

Solid generic_trap(const G4GenericTrap& s) {
  std::array<PlanarPoint, 8> corners;
  for (G4int i = 0; i < 8; ++i) corners[i] = {s.GetVertex(i).x(), s.GetVertex(i).y()};
  return make_arb8(s.GetName(), s.GetZHalfLength(), corners);
}

}  // namespace

Solid convert_contour(const G4VSolid& solid) {
  const std::type_info& type = typeid(solid);
  if (type == typeid(G4Polycone)) return polycone(static_cast<const G4Polycone&>(solid));
  if (type == typeid(G4Polyhedra)) return polyhedra(static_cast<const G4Polyhedra&>(solid));
  if (type == typeid(G4GenericPolycone)) {
    const auto& s = static_cast<const G4GenericPolycone&>(solid);
    return make_generic_polycone(s.GetName(), corners(s), s.GetStartPhi(),
                                 s.GetEndPhi() - s.GetStartPhi());
  }
  if (type == typeid(G4ExtrudedSolid)) return extruded(static_cast<const G4ExtrudedSolid&>(solid));
  if (type == typeid(G4TessellatedSolid)) {
    return tessellated(static_cast<const G4TessellatedSolid&>(solid));
  }
  if (type == typeid(G4Tet)) return tet(static_cast<const G4Tet&>(solid));
  if (type == typeid(G4GenericTrap)) return generic_trap(static_cast<const G4GenericTrap&>(solid));
  return {};
}

}  // namespace navjit::geant4
