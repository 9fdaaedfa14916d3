// Converts solids of several parts.
#include <G4AffineTransform.hh>
#include <G4DisplacedSolid.hh>
#include <G4IntersectionSolid.hh>
#include <G4MultiUnion.hh>
#include <G4ReflectedSolid.hh>
#include <G4ScaledSolid.hh>
#include <G4SubtractionSolid.hh>
#include <G4UnionSolid.hh>
#include <typeinfo>

#include "adapters/geant4/solids.hpp"

namespace navjit::geant4 {
namespace {

/// The map from an outer frame into that of a part, told by where the axes and the origin go.
template <typename Turn>
SolidFrame frame(const G4ThreeVector& origin, const Turn& turn) {
  SolidFrame frame;
  frame.translation[0] = origin.x();
  frame.translation[1] = origin.y();
  frame.translation[2] = origin.z();
  for (int column = 0; column < 3; ++column) {
    G4ThreeVector axis;
    axis[column] = 1;
    const G4ThreeVector turned = turn(axis);
    for (int row = 0; row < 3; ++row) frame.rotation[3 * row + column] = turned[row];
  }
  return frame;
}

Solid displaced(const G4DisplacedSolid& s, ForeignSolids& foreign) {
  const G4AffineTransform inward = s.GetTransform();
  return make_placed(s.GetName(), convert(*s.GetConstituentMovedSolid(), foreign),
                     frame(inward.InverseTransformPoint({0, 0, 0}),
                           [&](const G4ThreeVector& v) { return inward.TransformAxis(v); }));
}

/// The part, turned and moved by `inward`, which may reflect.
Solid transformed(const std::string& name, const G4VSolid& part, const G4Transform3D& inward,
                  ForeignSolids& foreign) {
  const G4Transform3D outward = inward.inverse();
  const bool reflected = HepGeom::Vector3D<double>(inward.xx(), inward.yx(), inward.zx())
                             .cross({inward.xy(), inward.yy(), inward.zy()})
                             .dot({inward.xz(), inward.yz(), inward.zz()}) < 0;
  Solid solid = convert(part, foreign);
  SolidFrame at = frame(outward.getTranslation(), [&](const G4ThreeVector& v) {
    const HepGeom::Vector3D<double> turned = inward * HepGeom::Vector3D<double>(v);
    return G4ThreeVector(turned.x(), turned.y(), turned.z());
  });
  if (reflected) {
    // The reflection is across z, in the part's own frame; the rest is a rotation.
    solid = make_scaled(name + "_mirrored", solid, 1, 1, -1);
    for (int column = 0; column < 3; ++column) at.rotation[6 + column] *= -1;
  }
  return make_placed(name, solid, at);
}

Solid multi_union(const G4MultiUnion& s, ForeignSolids& foreign) {
  Solid all;
  for (G4int i = 0; i < s.GetNumberOfSolids(); ++i) {
    const std::string name = s.GetName() + "_" + std::to_string(i);
    Solid part = transformed(name, *s.GetSolid(i), s.GetTransformation(i).inverse(), foreign);
    all = i == 0 ? std::move(part) : make_union(s.GetName(), all, part);
  }
  return all;
}

}  // namespace

Solid convert_composite(const G4VSolid& solid, ForeignSolids& foreign) {
  const std::type_info& type = typeid(solid);
  const auto part = [&](G4int i) { return convert(*solid.GetConstituentSolid(i), foreign); };
  if (type == typeid(G4UnionSolid)) return make_union(solid.GetName(), part(0), part(1));
  if (type == typeid(G4IntersectionSolid)) {
    return make_intersection(solid.GetName(), part(0), part(1));
  }
  if (type == typeid(G4SubtractionSolid)) {
    return make_subtraction(solid.GetName(), part(0), part(1));
  }
  if (type == typeid(G4DisplacedSolid)) {
    return displaced(static_cast<const G4DisplacedSolid&>(solid), foreign);
  }
  if (type == typeid(G4ScaledSolid)) {
    const auto& s = static_cast<const G4ScaledSolid&>(solid);
    const G4Scale3D scale = s.GetScaleTransform();
    return make_scaled(s.GetName(), convert(*s.GetUnscaledSolid(), foreign), scale.xx(), scale.yy(),
                       scale.zz());
  }
  if (type == typeid(G4ReflectedSolid)) {
    const auto& s = static_cast<const G4ReflectedSolid&>(solid);
    return transformed(s.GetName(), *s.GetConstituentMovedSolid(), s.GetDirectTransform3D(),
                       foreign);
  }
  if (type == typeid(G4MultiUnion))
    return multi_union(static_cast<const G4MultiUnion&>(solid), foreign);
  return {};
}

}  // namespace navjit::geant4
