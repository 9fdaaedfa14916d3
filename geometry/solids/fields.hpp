// The fields of every kernel's shape, in declaration order: what code generation prints, the
// fingerprint hashes, `inspect` shows and the high-precision reference converts.
//
// visit_fields(shape, visitor) calls visitor(name, field) for numbers and nested structs, and
// visitor(name, pointer, count) for arrays.
#pragma once

#include "geometry/solids/kernels.hpp"

namespace navjit::kernels {

template <class Real, class V>
void visit_fields(const Box<Real>& s, V&& visit) {
  visit("hx", s.hx);
  visit("hy", s.hy);
  visit("hz", s.hz);
}

template <class Real, class V>
void visit_fields(const Wedge<Real>& s, V&& visit) {
  visit("kind", s.kind);
  visit("start_x", s.start_x);
  visit("start_y", s.start_y);
  visit("end_x", s.end_x);
  visit("end_y", s.end_y);
}

template <class Real, class V>
void visit_fields(const Tube<Real>& s, V&& visit) {
  visit("rmin", s.rmin);
  visit("rmax", s.rmax);
  visit("hz", s.hz);
  visit("wedge", s.wedge);
}

template <class Real, class V>
void visit_fields(const ConicalFace<Real>& s, V&& visit) {
  visit("radius", s.radius);
  visit("slope", s.slope);
  visit("cosine", s.cosine);
}

template <class Real, class V>
void visit_fields(const Cone<Real>& s, V&& visit) {
  visit("hz", s.hz);
  visit("outer", s.outer);
  visit("inner", s.inner);
  visit("bored", s.bored);
  visit("wedge", s.wedge);
}

template <class Real, class V>
void visit_fields(const FacePair<Real>& s, V&& visit) {
  visit("across", s.across);
  visit("along", s.along);
  visit("offset", s.offset);
}

template <class Real, class V>
void visit_fields(const Trd<Real>& s, V&& visit) {
  visit("hz", s.hz);
  visit("x", s.x);
  visit("y", s.y);
}

template <class Real, class V>
void visit_fields(const Plane<Real>& s, V&& visit) {
  visit("a", s.a);
  visit("b", s.b);
  visit("c", s.c);
  visit("d", s.d);
}

template <class Real, class V>
void visit_fields(const Trap<Real>& s, V&& visit) {
  visit("hz", s.hz);
  visit("y_minus", s.y_minus);
  visit("y_plus", s.y_plus);
  visit("x_minus", s.x_minus);
  visit("x_plus", s.x_plus);
}

template <class Real, class V>
void visit_fields(const Hull<Real>& s, V&& visit) {
  visit("planes", s.planes, s.count);
  visit("count", s.count);
}

template <class Real, class V>
void visit_fields(const Vec3<Real>& s, V&& visit) {
  visit("x", s.x);
  visit("y", s.y);
  visit("z", s.z);
}

template <class V>
void visit_fields(const Facet& s, V&& visit) {
  visit("a", s.a);
  visit("b", s.b);
  visit("c", s.c);
}

template <class Real, class V>
void visit_fields(const FacetBox<Real>& s, V&& visit) {
  visit("x_low", s.x_low);
  visit("y_low", s.y_low);
  visit("z_low", s.z_low);
  visit("x_high", s.x_high);
  visit("y_high", s.y_high);
  visit("z_high", s.z_high);
  visit("first", s.first);
  visit("count", s.count);
  visit("next", s.next);
}

template <class Real, class V>
void visit_fields(const Facets<Real>& s, V&& visit) {
  visit("corners", s.corners, s.corner_count);
  visit("corner_count", s.corner_count);
  visit("facets", s.facets, s.facet_count);
  visit("facet_count", s.facet_count);
  visit("boxes", s.boxes, s.box_count);
  visit("box_count", s.box_count);
}

template <class Real, class V>
void visit_fields(const PlanarCorner<Real>& s, V&& visit) {
  visit("x", s.x);
  visit("y", s.y);
}

template <class Real, class V>
void visit_fields(const Prism<Real>& s, V&& visit) {
  visit("corners", s.corners, s.count);
  visit("count", s.count);
  visit("z_low", s.z_low);
  visit("z_high", s.z_high);
  visit("x_low", s.x_low);
  visit("x_high", s.x_high);
  visit("y_low", s.y_low);
  visit("y_high", s.y_high);
}

template <class Real, class V>
void visit_fields(const TwistedFace<Real>& s, V&& visit) {
  visit("a", s.a);
  visit("b", s.b);
  visit("c", s.c);
  visit("d", s.d);
  visit("e", s.e);
  visit("f", s.f);
  visit("g", s.g);
}

template <class Real, class V>
void visit_fields(const Arb8<Real>& s, V&& visit) {
  visit("hz", s.hz);
  visit("hx", s.hx);
  visit("hy", s.hy);
  visit("first", s.first);
  visit("second", s.second);
  visit("third", s.third);
  visit("fourth", s.fourth);
}

template <class Real, class V>
void visit_fields(const CutTube<Real>& s, V&& visit) {
  visit("rmin", s.rmin);
  visit("rmax", s.rmax);
  visit("low", s.low);
  visit("high", s.high);
  visit("wedge", s.wedge);
}

template <class Real, class V>
void visit_fields(const Orb<Real>& s, V&& visit) {
  visit("radius", s.radius);
}

template <class Real, class V>
void visit_fields(const PolarLimit<Real>& s, V&& visit) {
  visit("kind", s.kind);
  visit("face", s.face);
}

template <class Real, class V>
void visit_fields(const Sphere<Real>& s, V&& visit) {
  visit("rmin", s.rmin);
  visit("rmax", s.rmax);
  visit("wedge", s.wedge);
  visit("low", s.low);
  visit("high", s.high);
}

template <class Real, class V>
void visit_fields(const Section<Real>& s, V&& visit) {
  visit("z_low", s.z_low);
  visit("z_high", s.z_high);
  visit("outer", s.outer);
  visit("inner", s.inner);
  visit("bored", s.bored);
}

template <class Real, class V>
void visit_fields(const Ledge<Real>& s, V&& visit) {
  visit("z", s.z);
  visit("rmin", s.rmin);
  visit("rmax", s.rmax);
}

template <class Real, class V>
void visit_fields(const Polycone<Real>& s, V&& visit) {
  visit("sections", s.sections, s.count);
  visit("count", s.count);
  visit("ledges", s.ledges, s.ledge_count);
  visit("ledge_count", s.ledge_count);
  visit("z_low", s.z_low);
  visit("z_high", s.z_high);
  visit("rmax", s.rmax);
  visit("wedge", s.wedge);
}

template <class Real, class V>
void visit_fields(const SideNormal<Real>& s, V&& visit) {
  visit("x", s.x);
  visit("y", s.y);
}

template <class Real, class V>
void visit_fields(const Polyhedra<Real>& s, V&& visit) {
  visit("sections", s.sections, s.count);
  visit("count", s.count);
  visit("ledges", s.ledges, s.ledge_count);
  visit("ledge_count", s.ledge_count);
  visit("z_low", s.z_low);
  visit("z_high", s.z_high);
  visit("rmax", s.rmax);
  visit("wedge", s.wedge);
  visit("sides", s.sides, s.side_count);
  visit("side_count", s.side_count);
}

template <class Real, class V>
void visit_fields(const Torus<Real>& s, V&& visit) {
  visit("rmin", s.rmin);
  visit("rmax", s.rmax);
  visit("rtor", s.rtor);
  visit("wedge", s.wedge);
}

template <class Real, class V>
void visit_fields(const Quadric<Real>& s, V&& visit) {
  visit("a", s.a);
  visit("b", s.b);
  visit("c", s.c);
  visit("d", s.d);
  visit("e", s.e);
  visit("origin", s.origin);
}

template <class Real, class V>
void visit_fields(const Saddle<Real>& s, V&& visit) {
  visit("nx", s.nx);
  visit("ny", s.ny);
  visit("kappa", s.kappa);
}

template <class Real, class V>
void visit_fields(const TwistedTube<Real>& s, V&& visit) {
  visit("reach", s.reach);
  visit("z_low", s.z_low);
  visit("z_high", s.z_high);
  visit("outer", s.outer);
  visit("inner", s.inner);
  visit("start", s.start);
  visit("end", s.end);
}

template <class Real, class V>
void visit_fields(const TwistedSide<Real>& s, V&& visit) {
  visit("nu", s.nu);
  visit("nw", s.nw);
  visit("c0", s.c0);
  visit("c1", s.c1);
  visit("nu1", s.nu1);
  visit("nw1", s.nw1);
  visit("c2", s.c2);
}

template <class Real, class V>
void visit_fields(const TwistedTrap<Real>& s, V&& visit) {
  visit("hz", s.hz);
  visit("rate", s.rate);
  visit("shear_x", s.shear_x);
  visit("shear_y", s.shear_y);
  visit("hx", s.hx);
  visit("hy", s.hy);
  visit("reach", s.reach);
  visit("right", s.right);
  visit("left", s.left);
  visit("back", s.back);
  visit("front", s.front);
  visit("steep", s.steep);
  visit("steepening", s.steepening);
  visit("curve", s.curve);
}

template <class Real, class V>
void visit_fields(const QuadricSolid<Real>& s, V&& visit) {
  visit("hx", s.hx);
  visit("hy", s.hy);
  visit("z_low", s.z_low);
  visit("z_high", s.z_high);
  visit("outer", s.outer);
  visit("inner", s.inner);
  visit("bored", s.bored);
}

}  // namespace navjit::kernels
