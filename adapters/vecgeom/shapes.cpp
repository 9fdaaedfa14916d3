#include "adapters/vecgeom/shapes.hpp"

#include <VecGeom/volumes/PlacedVolume.h>
#include <VecGeom/volumes/UnplacedBooleanVolume.h>
#include <VecGeom/volumes/UnplacedBox.h>
#include <VecGeom/volumes/UnplacedCone.h>
#include <VecGeom/volumes/UnplacedCutTube.h>
#include <VecGeom/volumes/UnplacedEllipsoid.h>
#include <VecGeom/volumes/UnplacedEllipticalCone.h>
#include <VecGeom/volumes/UnplacedEllipticalTube.h>
#include <VecGeom/volumes/UnplacedExtruded.h>
#include <VecGeom/volumes/UnplacedGenTrap.h>
#include <VecGeom/volumes/UnplacedGenericPolycone.h>
#include <VecGeom/volumes/UnplacedHype.h>
#include <VecGeom/volumes/UnplacedMultiUnion.h>
#include <VecGeom/volumes/UnplacedOrb.h>
#include <VecGeom/volumes/UnplacedParaboloid.h>
#include <VecGeom/volumes/UnplacedParallelepiped.h>
#include <VecGeom/volumes/UnplacedPolycone.h>
#include <VecGeom/volumes/UnplacedPolyhedron.h>
#include <VecGeom/volumes/UnplacedSExtruVolume.h>
#include <VecGeom/volumes/UnplacedScaledShape.h>
#include <VecGeom/volumes/UnplacedSphere.h>
#include <VecGeom/volumes/UnplacedTessellated.h>
#include <VecGeom/volumes/UnplacedTet.h>
#include <VecGeom/volumes/UnplacedTorus2.h>
#include <VecGeom/volumes/UnplacedTrapezoid.h>
#include <VecGeom/volumes/UnplacedTrd.h>
#include <VecGeom/volumes/UnplacedTube.h>
#include <cxxabi.h>

#include <array>
#include <cstdlib>
#include <memory>
#include <typeinfo>
#include <vector>

#include "adapters/vecgeom/transformations.hpp"

namespace navjit::vecgeom {
namespace {

using ::vecgeom::Precision;
using ::vecgeom::VPlacedVolume;
using ::vecgeom::VUnplacedVolume;
using Vector = ::vecgeom::Vector3D<Precision>;

/// What a maker of solids needs besides the shape.
struct Making {
  const std::string& name;
  double mm;  ///< VecGeom's unit of length, mm

  Vec3 point(const Vector& p) const { return {mm * p.x(), mm * p.y(), mm * p.z()}; }
};

/// A solid; nothing for a shape that holds no point.
using Made = std::optional<Solid>;

/// An operand of a boolean, or a shape that is scaled.
Made placed(const VPlacedVolume& volume, const Making& m) {
  const Made solid = solid_of(*volume.GetUnplacedVolume(), m.name, m.mm);
  const ::vecgeom::Transformation3D& t = *volume.GetTransformation();
  if (!solid) return solid;
  // The flags of the transformation may not know of a reflection.
  const SolidFrame frame = frame_of(t, m.mm);
  return is_identity(frame) ? *solid : make_placed(m.name, *solid, frame);
}

bool meet(const Extent& a, const Extent& b) {
  return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y &&
         a.min.z <= b.max.z && b.min.z <= a.max.z;
}

Made united(const Made& left, const Made& right, const Making& m) {
  if (!left) return right;
  return right ? make_union(m.name, *left, *right) : left;
}

Made boolean(const ::vecgeom::BooleanStruct& b, const Making& m) {
  const Made left = placed(*b.fLeftVolume, m), right = placed(*b.fRightVolume, m);
  switch (b.fOp) {
    case ::vecgeom::kUnion:
      return united(left, right, m);
    case ::vecgeom::kIntersection:
      if (!left || !right || !meet(left->extent, right->extent)) return std::nullopt;
      return make_intersection(m.name, *left, *right);
    case ::vecgeom::kSubtraction:
      if (!left || !right) return left;
      return make_subtraction(m.name, *left, *right);
  }
  throw GeometryError("a boolean of VecGeom's that is none of union, intersection and subtraction");
}

Solid of(const ::vecgeom::UnplacedBox& s, const Making& m) {
  return make_box(m.name, m.mm * s.x(), m.mm * s.y(), m.mm * s.z());
}
Solid of(const ::vecgeom::UnplacedTube& s, const Making& m) {
  return make_tube(m.name, m.mm * s.rmin(), m.mm * s.rmax(), m.mm * s.z(), s.sphi(), s.dphi());
}
Solid of(const ::vecgeom::UnplacedCutTube& s, const Making& m) {
  const Vector low = s.BottomNormal(), high = s.TopNormal();
  return make_cut_tube(m.name, m.mm * s.rmin(), m.mm * s.rmax(), m.mm * s.z(), s.sphi(), s.dphi(),
                       {low.x(), low.y(), low.z()}, {high.x(), high.y(), high.z()});
}
Solid of(const ::vecgeom::UnplacedCone& s, const Making& m) {
  // If the radii are equal, VecGeom widens the outer one by its tolerance and keeps the original.
  const auto& cone = s.GetStruct();
  return make_cone(m.name, m.mm * s.GetRmin1(), m.mm * cone.fOriginalRmax1, m.mm * s.GetRmin2(),
                   m.mm * cone.fOriginalRmax2, m.mm * s.GetDz(), s.GetSPhi(), s.GetDPhi());
}
Solid of(const ::vecgeom::UnplacedTrd& s, const Making& m) {
  return make_trd(m.name, m.mm * s.dx1(), m.mm * s.dx2(), m.mm * s.dy1(), m.mm * s.dy2(),
                  m.mm * s.dz());
}
Solid of(const ::vecgeom::UnplacedTrapezoid& s, const Making& m) {
  return make_trap(m.name, m.mm * s.GetDz(), s.GetTheta(), s.GetPhi(), m.mm * s.GetDy1(),
                   m.mm * s.GetDx1(), m.mm * s.GetDx2(), s.GetAlpha1(), m.mm * s.GetDy2(),
                   m.mm * s.GetDx3(), m.mm * s.GetDx4(), s.GetAlpha2());
}
Solid of(const ::vecgeom::UnplacedParallelepiped& s, const Making& m) {
  return make_para(m.name, m.mm * s.GetX(), m.mm * s.GetY(), m.mm * s.GetZ(), s.GetAlpha(),
                   s.GetTheta(), s.GetPhi());
}
Solid of(const ::vecgeom::UnplacedTet& s, const Making& m) {
  const auto& corners = s.GetStruct().fVertex;
  return make_tet(m.name, m.point(corners[0]), m.point(corners[1]), m.point(corners[2]),
                  m.point(corners[3]));
}
Solid of(const ::vecgeom::UnplacedOrb& s, const Making& m) {
  return make_orb(m.name, m.mm * s.GetRadius());
}
Solid of(const ::vecgeom::UnplacedSphere& s, const Making& m) {
  return make_sphere(m.name, m.mm * s.GetInnerRadius(), m.mm * s.GetOuterRadius(),
                     s.GetStartPhiAngle(), s.GetDeltaPhiAngle(), s.GetStartThetaAngle(),
                     s.GetDeltaThetaAngle());
}
Solid of(const ::vecgeom::UnplacedTorus2& s, const Making& m) {
  return make_torus(m.name, m.mm * s.rmin(), m.mm * s.rmax(), m.mm * s.rtor(), s.sphi(), s.dphi());
}
Solid of(const ::vecgeom::UnplacedEllipsoid& s, const Making& m) {
  return make_ellipsoid(m.name, m.mm * s.GetDx(), m.mm * s.GetDy(), m.mm * s.GetDz(),
                        m.mm * s.GetZBottomCut(), m.mm * s.GetZTopCut());
}
Solid of(const ::vecgeom::UnplacedEllipticalTube& s, const Making& m) {
  return make_eltube(m.name, m.mm * s.GetDx(), m.mm * s.GetDy(), m.mm * s.GetDz());
}
Solid of(const ::vecgeom::UnplacedEllipticalCone& s, const Making& m) {
  return make_elcone(m.name, s.GetSemiAxisX(), s.GetSemiAxisY(), m.mm * s.GetZMax(),
                     m.mm * s.GetZTopCut());
}
Solid of(const ::vecgeom::UnplacedParaboloid& s, const Making& m) {
  const double low = m.mm * s.GetRlo(), high = m.mm * s.GetRhi(), hz = m.mm * s.GetDz();
  if (low <= high) return make_paraboloid(m.name, low, high, hz);
  return make_scaled(m.name, make_paraboloid(m.name, high, low, hz), 1, 1, -1);
}
Solid of(const ::vecgeom::UnplacedHype& s, const Making& m) {
  return make_hype(m.name, m.mm * s.GetRmin(), m.mm * s.GetRmax(), s.GetStIn(), s.GetStOut(),
                   m.mm * s.GetDz());
}
Solid of(const ::vecgeom::UnplacedPolycone& s, const Making& m) {
  // Each section has both ends: so planes at equal z that VecGeom left out come back as steps.
  const auto& all = s.GetStruct();
  const std::size_t sections = all.fSections.size();
  const bool exact = all.fZs.size() == sections + 1;  // z without the rounding of sections' frames
  std::vector<ZPlane> planes;
  for (std::size_t i = 0; i < sections; ++i) {
    const auto& section = all.fSections[i];
    const auto& cone = *section.fSolid;
    const double low = exact ? all.fZs[i] : section.fShift - cone.fDz;
    const double high = exact ? all.fZs[i + 1] : section.fShift + cone.fDz;
    for (const ZPlane& plane :
         {ZPlane{m.mm * low, m.mm * cone.fRmin1, m.mm * cone.fOriginalRmax1},
          ZPlane{m.mm * high, m.mm * cone.fRmin2, m.mm * cone.fOriginalRmax2}}) {
      if (planes.empty() || !(planes.back() == plane)) planes.push_back(plane);
    }
  }
  return make_polycone(m.name, planes, s.GetStartPhi(), s.GetDeltaPhi());
}
Solid of(const ::vecgeom::UnplacedPolyhedron& s, const Making& m) {
  std::vector<ZPlane> planes;
  for (int i = 0; i < static_cast<int>(s.GetZPlanes().size()); ++i) {
    planes.push_back({m.mm * s.GetZPlanes()[i], m.mm * s.GetRMin()[i], m.mm * s.GetRMax()[i]});
  }
  return make_polyhedra(m.name, planes, s.GetSideCount(), s.GetPhiStart(), s.GetPhiDelta());
}
Solid of(const ::vecgeom::UnplacedGenericPolycone& s, const Making& m) {
  const auto r = s.GetR(), z = s.GetZ();
  std::vector<ContourPoint> contour;
  for (std::size_t i = 0; i < r.size(); ++i) contour.push_back({m.mm * r[i], m.mm * z[i]});
  return make_generic_polycone(m.name, contour, s.GetSPhi(), s.GetDPhi());
}
Solid of(const ::vecgeom::UnplacedGenTrap& s, const Making& m) {
  std::array<PlanarPoint, 8> corners;
  for (int i = 0; i < 8; ++i) corners[i] = {m.mm * s.GetVerticesX()[i], m.mm * s.GetVerticesY()[i]};
  return make_arb8(m.name, m.mm * s.GetDZ(), corners);
}
Solid of(const ::vecgeom::UnplacedExtruded& s, const Making& m) {
  std::vector<PlanarPoint> polygon;
  for (std::size_t i = 0; i < s.GetNVertices(); ++i) {
    Precision x, y;
    s.GetVertex(static_cast<int>(i), x, y);
    polygon.push_back({m.mm * x, m.mm * y});
  }
  std::vector<ExtrudedSection> sections;
  for (std::size_t i = 0; i < s.GetNSections(); ++i) {
    const auto section = s.GetSection(static_cast<int>(i));
    const Vec3 origin = m.point(section.fOrigin);
    sections.push_back({origin.z, origin.x, origin.y, section.fScale});
  }
  return make_extruded(m.name, polygon, sections);
}
Solid of(const ::vecgeom::UnplacedSExtruVolume& s, const Making& m) {
  const auto& corners = s.GetStruct().GetPolygon().GetVertices();
  std::vector<PlanarPoint> polygon;
  for (std::size_t i = 0; i < corners.size(); ++i)
    polygon.push_back({m.mm * corners.x(i), m.mm * corners.y(i)});
  Vector low, high;
  s.Extent(low, high);
  const ExtrudedSection sections[] = {{m.mm * low.z(), 0, 0, 1}, {m.mm * high.z(), 0, 0, 1}};
  return make_extruded(m.name, polygon, sections);
}
Solid of(const ::vecgeom::UnplacedTessellated& s, const Making& m) {
  std::vector<FacetCorners> facets;
  for (std::size_t i = 0; i < s.GetNFacets(); ++i) {
    const auto& corners = s.GetFacet(static_cast<int>(i))->fVertices;
    facets.push_back({m.point(corners[0]), m.point(corners[1]), m.point(corners[2])});
  }
  return make_tessellated(m.name, facets);
}
Made of(const ::vecgeom::UnplacedMultiUnion& s, const Making& m) {
  Made all;
  for (std::size_t i = 0; i < s.GetNumberOfSolids(); ++i)
    all = united(all, placed(*s.GetNode(i), m), m);
  return all;
}
Made of(const ::vecgeom::UnplacedScaledShape& s, const Making& m) {
  const Made whole = placed(*s.GetPlaced(), m);
  const Vector& by = s.GetScale().Scale();
  return whole ? make_scaled(m.name, *whole, by.x(), by.y(), by.z()) : whole;
}

/// Sets the solid if the shape is of one of the classes; otherwise does nothing.
template <class... Shapes>
bool of_any(const VUnplacedVolume& shape, const Making& m, Made& solid) {
  const auto is = [&]<class Shape>(const Shape* as) {
    if (as == nullptr) return false;
    solid = of(*as, m);
    return true;
  };
  return (is(dynamic_cast<const Shapes*>(&shape)) || ...);
}

std::string class_of(const VUnplacedVolume& shape) {
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> name(
      abi::__cxa_demangle(typeid(shape).name(), nullptr, nullptr, &status), std::free);
  return status == 0 ? name.get() : typeid(shape).name();
}

}  // namespace

std::optional<Solid> solid_of(const VUnplacedVolume& shape, const std::string& name, double mm) {
  namespace vg = ::vecgeom;
  const Making making{name, mm};
  if (const vg::BooleanStruct* b = vg::BooleanHelper::GetBooleanStruct(&shape))
    return boolean(*b, making);
  Made solid;
  // The class of a special case is derived from the general one, too.
  if (of_any<vg::UnplacedBox, vg::UnplacedTube, vg::UnplacedCone, vg::UnplacedTrd,
             vg::UnplacedTrapezoid, vg::UnplacedParallelepiped, vg::UnplacedTet, vg::UnplacedOrb,
             vg::UnplacedSphere, vg::UnplacedTorus2, vg::UnplacedPolycone, vg::UnplacedPolyhedron,
             vg::UnplacedGenericPolycone, vg::UnplacedCutTube, vg::UnplacedEllipsoid,
             vg::UnplacedEllipticalTube, vg::UnplacedEllipticalCone, vg::UnplacedParaboloid,
             vg::UnplacedHype, vg::UnplacedGenTrap, vg::UnplacedExtruded, vg::UnplacedSExtruVolume,
             vg::UnplacedTessellated, vg::UnplacedMultiUnion, vg::UnplacedScaledShape>(
          shape, making, solid))
    return solid;
  throw GeometryError("there is no kernel for shapes of class " + class_of(shape));
}

}  // namespace navjit::vecgeom
