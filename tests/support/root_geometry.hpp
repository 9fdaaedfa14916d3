// Pieces of a geometry of ROOT's, and the file that holds it.
#pragma once

#include "tests/support/root_file.hpp"

namespace navjit::tests {

inline RootPointer root_box(const std::string& name, double x, double y, double z) {
  return root_object(
      "TGeoBBox", name,
      {{"fDX", x}, {"fDY", y}, {"fDZ", z}, {"fOrigin", std::vector<double>{0, 0, 0}}});
}

inline RootPointer root_translation(double x, double y, double z) {
  return root_object("TGeoTranslation", "", {{"fTranslation", std::vector<double>{x, y, z}}});
}

/// Rows of the matrix that turns local vectors into the mother's.
inline RootPointer root_rotation(const std::vector<double>& rows) {
  return root_object("TGeoRotation", "", {{"fRotationMatrix", rows}});
}

inline RootPointer root_placed(double x, double y, double z, const std::vector<double>& rows) {
  return root_object(
      "TGeoCombiTrans", "",
      {{"fTranslation", std::vector<double>{x, y, z}}, {"fRotation", root_rotation(rows)}});
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
