#include "adapters/geant4/solids.hpp"

#include <G4Box.hh>
#include <G4Cons.hh>
#include <G4CutTubs.hh>
#include <G4Ellipsoid.hh>
#include <G4EllipticalCone.hh>
#include <G4EllipticalTube.hh>
#include <G4Hype.hh>
#include <G4Orb.hh>
#include <G4Para.hh>
#include <G4Paraboloid.hh>
#include <G4Sphere.hh>
#include <G4Torus.hh>
#include <G4Trap.hh>
#include <G4Trd.hh>
#include <G4Tubs.hh>
#include <G4TwistedBox.hh>
#include <G4TwistedTrap.hh>
#include <G4TwistedTrd.hh>
#include <G4TwistedTubs.hh>
#include <sstream>
#include <typeindex>
#include <unordered_map>

#include "adapters/geant4/vector.hpp"
#include "navjit/geant4/geometry.hpp"

namespace navjit::geant4 {
namespace {

Solid box(const G4Box& s) {
  return make_box(s.GetName(), s.GetXHalfLength(), s.GetYHalfLength(), s.GetZHalfLength());
}
Solid tubs(const G4Tubs& s) {
  return make_tube(s.GetName(), s.GetInnerRadius(), s.GetOuterRadius(), s.GetZHalfLength(),
                   s.GetStartPhiAngle(), s.GetDeltaPhiAngle());
}
Solid cons(const G4Cons& s) {
  return make_cone(s.GetName(), s.GetInnerRadiusMinusZ(), s.GetOuterRadiusMinusZ(),
                   s.GetInnerRadiusPlusZ(), s.GetOuterRadiusPlusZ(), s.GetZHalfLength(),
                   s.GetStartPhiAngle(), s.GetDeltaPhiAngle());
}
Solid cut_tubs(const G4CutTubs& s) {
  return make_cut_tube(s.GetName(), s.GetInnerRadius(), s.GetOuterRadius(), s.GetZHalfLength(),
                       s.GetStartPhiAngle(), s.GetDeltaPhiAngle(), vector(s.GetLowNorm()),
                       vector(s.GetHighNorm()));
}
Solid trd(const G4Trd& s) {
  return make_trd(s.GetName(), s.GetXHalfLength1(), s.GetXHalfLength2(), s.GetYHalfLength1(),
                  s.GetYHalfLength2(), s.GetZHalfLength());
}
Solid trap(const G4Trap& s) {
  return make_trap(s.GetName(), s.GetZHalfLength(), s.GetTheta(), s.GetPhi(), s.GetYHalfLength1(),
                   s.GetXHalfLength1(), s.GetXHalfLength2(), s.GetAlpha1(), s.GetYHalfLength2(),
                   s.GetXHalfLength3(), s.GetXHalfLength4(), s.GetAlpha2());
}
Solid para(const G4Para& s) {
  return make_para(s.GetName(), s.GetXHalfLength(), s.GetYHalfLength(), s.GetZHalfLength(),
                   s.GetAlpha(), s.GetTheta(), s.GetPhi());
}
Solid orb(const G4Orb& s) { return make_orb(s.GetName(), s.GetRadius()); }
Solid sphere(const G4Sphere& s) {
  return make_sphere(s.GetName(), s.GetInnerRadius(), s.GetOuterRadius(), s.GetStartPhiAngle(),
                     s.GetDeltaPhiAngle(), s.GetStartThetaAngle(), s.GetDeltaThetaAngle());
}
Solid torus(const G4Torus& s) {
  return make_torus(s.GetName(), s.GetRmin(), s.GetRmax(), s.GetRtor(), s.GetSPhi(), s.GetDPhi());
}
Solid ellipsoid(const G4Ellipsoid& s) {
  const bool whole = s.GetZBottomCut() <= -s.GetDz() && s.GetZTopCut() >= s.GetDz();
  return make_ellipsoid(s.GetName(), s.GetDx(), s.GetDy(), s.GetDz(), whole ? 0 : s.GetZBottomCut(),
                        whole ? 0 : s.GetZTopCut());
}
Solid elliptical_tube(const G4EllipticalTube& s) {
  return make_eltube(s.GetName(), s.GetDx(), s.GetDy(), s.GetDz());
}
Solid elliptical_cone(const G4EllipticalCone& s) {
  return make_elcone(s.GetName(), s.GetSemiAxisX(), s.GetSemiAxisY(), s.GetZMax(), s.GetZTopCut());
}
Solid paraboloid(const G4Paraboloid& s) {
  return make_paraboloid(s.GetName(), s.GetRadiusMinusZ(), s.GetRadiusPlusZ(), s.GetZHalfLength());
}
Solid hype(const G4Hype& s) {
  return make_hype(s.GetName(), s.GetInnerRadius(), s.GetOuterRadius(), s.GetInnerStereo(),
                   s.GetOuterStereo(), s.GetZHalfLength());
}
Solid twisted_tubs(const G4TwistedTubs& s) {
  return make_twistedtubs(s.GetName(), s.GetPhiTwist(), s.GetInnerRadius(), s.GetOuterRadius(),
                          s.GetEndZ(0), s.GetEndZ(1), s.GetDPhi());
}
Solid twisted_box(const G4TwistedBox& s) {
  return make_twistedbox(s.GetName(), s.GetPhiTwist(), s.GetXHalfLength(), s.GetYHalfLength(),
                         s.GetZHalfLength());
}
Solid twisted_trd(const G4TwistedTrd& s) {
  return make_twistedtrd(s.GetName(), s.GetX1HalfLength(), s.GetX2HalfLength(), s.GetY1HalfLength(),
                         s.GetY2HalfLength(), s.GetZHalfLength(), s.GetPhiTwist());
}
Solid twisted_trap(const G4TwistedTrap& s) {
  return make_twistedtrap(s.GetName(), s.GetPhiTwist(), s.GetZHalfLength(), s.GetPolarAngleTheta(),
                          s.GetAzimuthalAnglePhi(), s.GetY1HalfLength(), s.GetX1HalfLength(),
                          s.GetX2HalfLength(), s.GetY2HalfLength(), s.GetX3HalfLength(),
                          s.GetX4HalfLength(), s.GetTiltAngleAlpha());
}

using Maker = Solid (*)(const G4VSolid&);

template <typename S, Solid (*make)(const S&)>
std::pair<const std::type_index, Maker> entry() {
  return {typeid(S), [](const G4VSolid& s) { return make(static_cast<const S&>(s)); }};
}

/// The solid; empty if there is no kernel for it.
Solid convert_known(const G4VSolid& solid, ForeignSolids& foreign) {
  static const std::unordered_map<std::type_index, Maker> makers{
      entry<G4Box, box>(),
      entry<G4Tubs, tubs>(),
      entry<G4Cons, cons>(),
      entry<G4CutTubs, cut_tubs>(),
      entry<G4Trd, trd>(),
      entry<G4Trap, trap>(),
      entry<G4Para, para>(),
      entry<G4Orb, orb>(),
      entry<G4Sphere, sphere>(),
      entry<G4Torus, torus>(),
      entry<G4Ellipsoid, ellipsoid>(),
      entry<G4EllipticalTube, elliptical_tube>(),
      entry<G4EllipticalCone, elliptical_cone>(),
      entry<G4Paraboloid, paraboloid>(),
      entry<G4Hype, hype>(),
      entry<G4TwistedTubs, twisted_tubs>(),
      entry<G4TwistedBox, twisted_box>(),
      entry<G4TwistedTrd, twisted_trd>(),
      entry<G4TwistedTrap, twisted_trap>(),
  };
  if (const auto maker = makers.find(typeid(solid)); maker != makers.end()) {
    return maker->second(solid);
  }
  if (Solid converted = convert_contour(solid); converted.shape) return converted;
  return convert_composite(solid, foreign);
}

}  // namespace

std::string text_of(const G4VSolid& solid) {
  std::ostringstream text;
  text.precision(17);
  solid.StreamInfo(text);
  return std::move(text).str();
}

Solid convert(const G4VSolid& solid, ForeignSolids& foreign) {
  const std::size_t before = foreign.size();
  try {
    if (Solid converted = convert_known(solid, foreign); converted.shape) return converted;
  } catch (const GeometryError&) {
    foreign.resize(before);  // Geant4 accepts dimensions that navjit's makers refuse
  }
  foreign.push_back(&solid);
  return convert_foreign(solid);
}

}  // namespace navjit::geant4
