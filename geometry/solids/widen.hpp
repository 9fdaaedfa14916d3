// The same solid in another number type, for references in higher precision. The solid's numbers
// are taken over as they are: the shape in double is the definition.
#pragma once

#include <algorithm>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "geometry/solids/solid.hpp"

namespace navjit {

/// Owns a copy of a solid, with everything that it is made of, in numbers of type Real.
template <class Real>
class WideSolid {
 public:
  explicit WideSolid(const Solid& solid) : root_(wide(solid.any())) {}

  /// Valid as long as this object or a copy of it lives.
  kernels::AnySolid<Real> any() const { return root_; }

 private:
  kernels::AnySolid<Real> wide(const kernels::AnySolid<double>& s) {
    const void* shape = kernels::visit(s, [this](const auto& from) -> const void* {
      auto to = this->wide(from);
      return this->keep(std::make_shared<decltype(to)>(to));
    });
    return {s.kind, shape};
  }
  template <class Shape>
  const Shape* keep(std::shared_ptr<Shape> shape) {
    const Shape* kept = shape.get();
    kept_.push_back(std::move(shape));
    return kept;
  }
  template <class Element>
  auto wide_array(const Element* from, int count) {
    using WideElement = decltype(wide(*from));
    auto to = std::make_shared<std::vector<WideElement>>();
    for (int i = 0; i < count; ++i) to->push_back(wide(from[i]));
    return keep(std::move(to))->data();
  }

  static Real wide(double x) { return static_cast<Real>(x); }

  kernels::Box<Real> wide(const kernels::Box<double>& s) {
    return {wide(s.hx), wide(s.hy), wide(s.hz)};
  }
  kernels::Wedge<Real> wide(const kernels::Wedge<double>& s) {
    return {s.kind, wide(s.start_x), wide(s.start_y), wide(s.end_x), wide(s.end_y)};
  }
  kernels::Tube<Real> wide(const kernels::Tube<double>& s) {
    return {wide(s.rmin), wide(s.rmax), wide(s.hz), wide(s.wedge)};
  }
  kernels::ConicalFace<Real> wide(const kernels::ConicalFace<double>& s) {
    return {wide(s.radius), wide(s.slope), wide(s.cosine)};
  }
  kernels::Cone<Real> wide(const kernels::Cone<double>& s) {
    return {wide(s.hz), wide(s.outer), wide(s.inner), s.bored, wide(s.wedge)};
  }
  kernels::FacePair<Real> wide(const kernels::FacePair<double>& s) {
    return {wide(s.across), wide(s.along), wide(s.offset)};
  }
  kernels::Trd<Real> wide(const kernels::Trd<double>& s) {
    return {wide(s.hz), wide(s.x), wide(s.y)};
  }
  kernels::Plane<Real> wide(const kernels::Plane<double>& s) {
    return {wide(s.a), wide(s.b), wide(s.c), wide(s.d)};
  }
  kernels::Trap<Real> wide(const kernels::Trap<double>& s) {
    return {wide(s.hz), wide(s.y_minus), wide(s.y_plus), wide(s.x_minus), wide(s.x_plus)};
  }
  kernels::Hull<Real> wide(const kernels::Hull<double>& s) {
    return {wide_array(s.planes, s.count), s.count};
  }
  kernels::Vec3<Real> wide(const kernels::Vec3<double>& s) {
    return {wide(s.x), wide(s.y), wide(s.z)};
  }
  static kernels::Facet wide(const kernels::Facet& s) { return s; }
  kernels::FacetBox<Real> wide(const kernels::FacetBox<double>& s) {
    return {wide(s.x_low),  wide(s.y_low), wide(s.z_low), wide(s.x_high), wide(s.y_high),
            wide(s.z_high), s.first,       s.count,       s.next};
  }
  kernels::Facets<Real> wide(const kernels::Facets<double>& s) {
    return {wide_array(s.corners, s.corner_count), s.corner_count,
            wide_array(s.facets, s.facet_count),   s.facet_count,
            wide_array(s.boxes, s.box_count),      s.box_count};
  }
  kernels::PlanarCorner<Real> wide(const kernels::PlanarCorner<double>& s) {
    return {wide(s.x), wide(s.y)};
  }
  kernels::Prism<Real> wide(const kernels::Prism<double>& s) {
    return {wide_array(s.corners, s.count),
            s.count,
            wide(s.z_low),
            wide(s.z_high),
            wide(s.x_low),
            wide(s.x_high),
            wide(s.y_low),
            wide(s.y_high)};
  }
  kernels::TwistedFace<Real> wide(const kernels::TwistedFace<double>& s) {
    return {wide(s.a), wide(s.b), wide(s.c), wide(s.d), wide(s.e), wide(s.f), wide(s.g)};
  }
  kernels::Arb8<Real> wide(const kernels::Arb8<double>& s) {
    return {wide(s.hz),     wide(s.hx),    wide(s.hy),    wide(s.first),
            wide(s.second), wide(s.third), wide(s.fourth)};
  }
  kernels::CutTube<Real> wide(const kernels::CutTube<double>& s) {
    return {wide(s.rmin), wide(s.rmax), wide(s.low), wide(s.high), wide(s.wedge)};
  }
  kernels::AnyScaled<Real> wide(const kernels::AnyScaled<double>& s) {
    return {wide(s.solid), wide(s.inverse_x), wide(s.inverse_y), wide(s.inverse_z), wide(s.most)};
  }
  kernels::Orb<Real> wide(const kernels::Orb<double>& s) { return {wide(s.radius)}; }
  kernels::PolarLimit<Real> wide(const kernels::PolarLimit<double>& s) {
    return {s.kind, wide(s.face)};
  }
  kernels::Sphere<Real> wide(const kernels::Sphere<double>& s) {
    return {wide(s.rmin), wide(s.rmax), wide(s.wedge), wide(s.low), wide(s.high)};
  }
  kernels::Section<Real> wide(const kernels::Section<double>& s) {
    return {wide(s.z_low), wide(s.z_high), wide(s.outer), wide(s.inner), s.bored};
  }
  kernels::Ledge<Real> wide(const kernels::Ledge<double>& s) {
    return {wide(s.z), wide(s.rmin), wide(s.rmax)};
  }
  kernels::Polycone<Real> wide(const kernels::Polycone<double>& s) {
    return {wide_array(s.sections, s.count),
            s.count,
            wide_array(s.ledges, s.ledge_count),
            s.ledge_count,
            wide(s.z_low),
            wide(s.z_high),
            wide(s.rmax),
            wide(s.wedge)};
  }
  kernels::SideNormal<Real> wide(const kernels::SideNormal<double>& s) {
    return {wide(s.x), wide(s.y)};
  }
  kernels::Polyhedra<Real> wide(const kernels::Polyhedra<double>& s) {
    return {wide_array(s.sections, s.count),
            s.count,
            wide_array(s.ledges, s.ledge_count),
            s.ledge_count,
            wide(s.z_low),
            wide(s.z_high),
            wide(s.rmax),
            wide(s.wedge),
            wide_array(s.sides, s.side_count),
            s.side_count};
  }
  kernels::Torus<Real> wide(const kernels::Torus<double>& s) {
    return {wide(s.rmin), wide(s.rmax), wide(s.rtor), wide(s.wedge)};
  }
  kernels::Quadric<Real> wide(const kernels::Quadric<double>& s) {
    return {wide(s.a), wide(s.b), wide(s.c), wide(s.d), wide(s.e), wide(s.origin)};
  }
  kernels::Saddle<Real> wide(const kernels::Saddle<double>& s) {
    return {wide(s.nx), wide(s.ny), wide(s.kappa)};
  }
  kernels::TwistedTube<Real> wide(const kernels::TwistedTube<double>& s) {
    return {wide(s.reach), wide(s.z_low), wide(s.z_high), wide(s.outer),
            wide(s.inner), wide(s.start), wide(s.end)};
  }
  kernels::TwistedSide<Real> wide(const kernels::TwistedSide<double>& s) {
    return {wide(s.nu), wide(s.nw), wide(s.c0), wide(s.c1), wide(s.nu1), wide(s.nw1), wide(s.c2)};
  }
  kernels::TwistedTrap<Real> wide(const kernels::TwistedTrap<double>& s) {
    return {wide(s.hz),    wide(s.rate),  wide(s.shear_x),    wide(s.shear_y), wide(s.hx),
            wide(s.hy),    wide(s.reach), wide(s.right),      wide(s.left),    wide(s.back),
            wide(s.front), wide(s.steep), wide(s.steepening), wide(s.curve)};
  }
  kernels::QuadricSolid<Real> wide(const kernels::QuadricSolid<double>& s) {
    return {wide(s.hx),    wide(s.hy),    wide(s.z_low), wide(s.z_high),
            wide(s.outer), wide(s.inner), s.bored};
  }
  kernels::AnyPlaced<Real> wide(const kernels::AnyPlaced<double>& s) {
    kernels::AnyPlaced<Real> to{wide(s.solid), s.rotated, {}, {}};
    std::copy_n(s.translation, 3, to.translation);
    std::copy_n(s.rotation, 9, to.rotation);
    return to;
  }
  // The reference looks at every operand.
  kernels::AnyOperand<Real> wide(const kernels::AnyOperand<double>& s) {
    return {wide(s.solid), 0, {}, {}};
  }
  kernels::AnyUnion<Real> wide(const kernels::AnyUnion<double>& s) {
    return {wide(s.a), wide(s.b)};
  }
  kernels::AnyIntersection<Real> wide(const kernels::AnyIntersection<double>& s) {
    return {wide(s.a), wide(s.b)};
  }
  kernels::AnySubtraction<Real> wide(const kernels::AnySubtraction<double>& s) {
    return {wide(s.a), wide(s.b)};
  }

  std::vector<std::shared_ptr<const void>> kept_;
  kernels::AnySolid<Real> root_;
};

/// The solid in numbers of type Real, which holds every double exactly.
template <class Real>
WideSolid<Real> widen(const Solid& solid) {
  return WideSolid<Real>(solid);
}

}  // namespace navjit
