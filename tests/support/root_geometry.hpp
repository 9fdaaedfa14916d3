// Parts of a geometry of ROOT, and the file that holds it.
#pragma once

#include "tests/support/root_file.hpp"

namespace navjit::tests {

inline RootPointer root_box(const std::string& name, double x, double y, double z) {
  return root_object(
      "TGeoBBox", name,
      {{"fDX", x}, {"fDY", y}, {"fDZ", z}, {"fOrigin", std::vector<double>{0, 0, 0}}});
}

/// How a version of ROOT writes tessellated solids.
struct RootFacetStyle {
  std::string vertex_class = "ROOT::Geom::Vertex_t";
  bool by_members = true;
  bool shared = false;  ///< facets have a member fShared, which comes last
};

/// Vertices of three coordinates, facets of three or four vertices.
inline RootPointer root_tessellated(const std::string& name,
                                    const std::vector<std::vector<double>>& vertices,
                                    const std::vector<std::vector<int>>& facets,
                                    const RootFacetStyle& style = {}) {
  const auto plain = [](const std::string& type,
                        std::vector<std::pair<std::string, RootValue>> members) {
    const RootPointer it = root_object(type, "", std::move(members));
    it->named = false;
    return it;
  };
  RootVector points{style.vertex_class, {}, style.by_members};
  for (const std::vector<double>& p : vertices) {
    points.objects.push_back(plain(style.vertex_class, {{"fVec", p}}));
  }
  RootVector faces{"TGeoFacet", {}, style.by_members};
  for (std::vector<int> corners : facets) {
    const auto count = static_cast<int>(corners.size());
    corners.resize(4, -1);
    faces.objects.push_back(plain("TGeoFacet", {{"fIvert", corners}, {"fNvert", count}}));
    if (style.shared) faces.objects.back()->members.emplace_back("fShared", 1);
  }
  return root_object("TGeoTessellated", name,
                     {{"fNfacets", static_cast<int>(facets.size())},
                      {"fNvert", static_cast<int>(vertices.size())},
                      {"fNseg", 0},
                      {"fVertices", points},
                      {"fFacets", faces}});
}

inline RootPointer root_translation(double x, double y, double z) {
  return root_object("TGeoTranslation", "", {{"fTranslation", std::vector<double>{x, y, z}}});
}

/// The rows of the matrix that turns local vectors into the mother's frame.
inline RootPointer root_rotation(const std::vector<double>& rows) {
  return root_object("TGeoRotation", "", {{"fRotationMatrix", rows}});
}

inline RootPointer root_placed(double x, double y, double z, const std::vector<double>& rows) {
  return root_object(
      "TGeoCombiTrans", "",
      {{"fTranslation", std::vector<double>{x, y, z}}, {"fRotation", root_rotation(rows)}});
}

/// "TGeoUnion", "TGeoSubtraction" or "TGeoIntersection" of two shapes.
inline RootPointer root_boolean(const std::string& operation, const RootPointer& a,
                                const RootPointer& b, const RootPointer& a_matrix = {},
                                const RootPointer& b_matrix = {}) {
  const RootPointer base =
      root_object("TGeoBoolNode", "",
                  {{"fLeft", a}, {"fRight", b}, {"fLeftMat", a_matrix}, {"fRightMat", b_matrix}});
  const RootPointer node = root_object(operation, "", {{"TGeoBoolNode", RootBase{base}}});
  node->named = false;
  return root_object("TGeoCompositeShape", "boolean", {{"fNode", node}});
}

/// The half space that the normal at the point leads out of.
inline RootPointer root_half_space(const std::vector<double>& point,
                                   const std::vector<double>& normal) {
  return root_object("TGeoHalfSpace", "half", {{"fP", point}, {"fN", normal}});
}

/// A material of one element.
inline RootPointer root_material(const std::string& name, double z, double a, double density) {
  return root_object("TGeoMaterial", name,
                     {{"fA", a},
                      {"fZ", z},
                      {"fDensity", density},
                      {"fRadLen", 0.0},
                      {"fTemperature", 300.0},
                      {"fState", 1},
                      {"fElement", RootPointer{}}});
}

inline RootPointer root_medium(const std::string& name, const RootPointer& material) {
  return root_object("TGeoMedium", name, {{"fMaterial", material}});
}

inline RootPointer root_lead() {
  static const RootPointer medium =
      root_medium("leadmedium", root_material("Lead", 82, 207.2, 11.35));
  return medium;
}

inline RootPointer root_volume(const std::string& name, const RootPointer& shape,
                               const std::vector<RootPointer>& nodes = {},
                               const RootPointer& medium = root_lead()) {
  return root_object("TGeoVolume", name,
                     {{"fNodes", RootList{nodes}},
                      {"fShape", shape},
                      {"fMedium", medium},
                      {"fFinder", RootPointer{}}});
}

inline RootPointer root_node(const std::string& name, const RootPointer& volume, int number,
                             const RootPointer& matrix, std::uint32_t bits = 0x03000000) {
  // As in ROOT the volume is a member of the base class.
  const RootPointer base =
      root_object("TGeoNode", name, {{"fVolume", volume}, {"fNumber", number}}, bits);
  const RootPointer node =
      root_object("TGeoNodeMatrix", name, {{"TGeoNode", RootBase{base}}, {"fMatrix", matrix}});
  node->named = false;
  return node;
}

inline RootPointer root_manager(const RootPointer& world) {
  return root_object("TGeoManager", "geometry", {{"fMasterVolume", world}});
}

/// A world of 10 m with the volume of a shape in its middle.
inline RootPointer root_world_around(const RootPointer& shape) {
  const RootPointer inner = root_volume("inner", shape);
  return root_volume("world", root_box("worldbox", 500, 500, 500),
                     {root_node("inner_1", inner, 1, root_translation(0, 0, 0))});
}

}  // namespace navjit::tests
