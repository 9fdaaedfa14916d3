// Kernels give the same bits whether the compiler knows a solid's numbers or not. So generated code
// with literals can agree exactly with the generic kernels.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "tests/geometry/kernels/random_solids.hpp"

namespace navjit::test {
namespace {

using namespace kernels;  // NOLINT: the kernels are the subject
using V = kernels::Vec3<double>;
using D = kernels::Direction<double>;

constexpr Wedge<double> segment{1, 0.8, 0.6, -0.28, 0.96};
constexpr Wedge<double> gapped{2, 0.8, 0.6, 0.28, -0.96};
constexpr Wedge<double> full{0, 1, 0, 1, 0};

constexpr Box<double> box{1.1, 0.7, 0.9};
constexpr Tube<double> tube{0.3, 1.1, 0.7, segment};
constexpr Tube<double> gapped_tube{0, 1.1, 0.7, gapped};
constexpr Cone<double> cone{0.9, {0.64, -0.6, 0.8}, {0.3, 0.28, 0.96}, 1, full};
constexpr Trd<double> trd{0.9, {0.8, 0.6, 0.7}, {0.96, -0.28, 0.8}};
constexpr Trap<double> trap{
    0.8, {0, -0.96, 0.28, -0.7}, {0, 0.8, 0.6, -0.5}, {-0.8, 0, 0.6, -0.6}, {1, 0, 0, -0.7}};
constexpr Plane<double> planes[] = {{0, 0, -1, -0.7},
                                    {0.8, 0, 0.6, -0.6},
                                    {-0.96, 0.28, 0, -0.5},
                                    {0, -0.6, 0.8, -0.7},
                                    {0, 0.8, 0.6, -0.6}};
constexpr PlaneGroup<double> plane_groups[] = {{{0, 0.8, -0.96, 0, 0, 0, 0, 0},
                                                {0, 0, 0.28, -0.6, 0.8, 0.8, 0.8, 0.8},
                                                {-1, 0.6, 0, 0.8, 0.6, 0.6, 0.6, 0.6},
                                                {-0.7, -0.6, -0.5, -0.7, -0.6, -0.6, -0.6, -0.6}}};
constexpr Hull<double> hull{planes, 5, plane_groups, 1};
constexpr V corners[] = {{-0.9, -0.8, -0.7}, {1.1, -0.6, -0.5}, {0.2, 1.2, -0.6}, {0.1, 0.1, 1.3}};
constexpr Facet triangles[] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
constexpr FacetBox<double> boxes[] = {{-0.9, -0.8, -0.7, 1.1, 1.2, 1.3, 0, 4, 1}};
constexpr double no = __builtin_inf();
constexpr FacetGroup<double> groups[] = {{{-0.9, no, no, no, no, no, no, no},
                                          {-0.8, no, no, no, no, no, no, no},
                                          {-0.7, no, no, no, no, no, no, no},
                                          {1.1, -no, -no, -no, -no, -no, -no, -no},
                                          {1.2, -no, -no, -no, -no, -no, -no, -no},
                                          {1.3, -no, -no, -no, -no, -no, -no, -no},
                                          {-1, 0, 0, 0, 0, 0, 0, 0}}};
constexpr FacetLeaf<double> leaves[] = {{{{-0.9, -0.9, 1.1, 0.2, -0.9, -0.9, -0.9, -0.9},
                                          {-0.8, -0.8, -0.6, 1.2, -0.8, -0.8, -0.8, -0.8},
                                          {-0.7, -0.7, -0.5, -0.6, -0.7, -0.7, -0.7, -0.7}},
                                         {{0.2, 1.1, 0.2, -0.9, -0.9, -0.9, -0.9, -0.9},
                                          {1.2, -0.6, 1.2, -0.8, -0.8, -0.8, -0.8, -0.8},
                                          {-0.6, -0.5, -0.6, -0.7, -0.7, -0.7, -0.7, -0.7}},
                                         {{1.1, 0.1, 0.1, 0.1, -0.9, -0.9, -0.9, -0.9},
                                          {-0.6, 0.1, 0.1, 0.1, -0.8, -0.8, -0.8, -0.8},
                                          {-0.5, 1.3, 1.3, 1.3, -0.7, -0.7, -0.7, -0.7}},
                                         0}};
constexpr Facets<double> facets{corners, 4, triangles, 4, boxes, 1, groups, 1, leaves, 1};
constexpr PlanarCorner<double> outline[] = {
    {-0.9, -0.8}, {1.1, -0.6}, {0.9, 0.8}, {0.2, -0.1}, {-0.7, 0.9}};
constexpr CornerGroup<double> outline_groups[] = {
    {{-0.9, 1.1, 0.9, 0.2, -0.7, -0.7, -0.7, -0.7}, {-0.8, -0.6, 0.8, -0.1, 0.9, 0.9, 0.9, 0.9}}};
constexpr Prism<double> prism{outline, 5, outline_groups, 1, -0.7, 0.9, -0.9, 1.1, -0.8, 0.9};
constexpr Arb8<double> arb8{0.8,
                            1.2,
                            1.2,
                            {0.1, 0.2, 0.05, 0.1, 0.8, 0.6, -0.7},
                            {0, 0, 0, 0.28, -0.96, 0, -0.6},
                            {-0.1, 0.1, 0, 0, 0, -1, -0.6},
                            {0, 0, 0, 0, 0.6, -0.8, -0.7},
                            {{0.8, -0.96, 0, 0.6},
                             {0.6, 0, -1, -0.8},
                             {0, 0.28, 0, 0},
                             {-0.7, -0.6, -0.6, -0.7},
                             {0.4, 1e-9, 0.3, 1e-9},
                             {0.2, 1e-9, 0.1, 1e-9}}};
constexpr CutTube<double> cut_tube{0.3, 1.1, {0.28, 0, -0.96, -0.6}, {0, 0.6, 0.8, -0.5}, gapped};
constexpr Orb<double> orb{1.05};
constexpr Sphere<double> sphere{0.4, 1.2, gapped, {2, {0, 0.6, 0.8}}, {2, {0, -0.28, 0.96}}};
constexpr Section<double> sections[] = {{-1, 0.2, {0.7, 0.28, 0.96}, {0.2, 0, 1}, 1},
                                        {0.2, 1, {0.8, -0.6, 0.8}, {0, 0, 1}, 0}};
constexpr Ledge<double> ledges[] = {{-1, 0.2, 0.73}, {0.2, 0, 0.2}, {1, 0, 0.4}};
constexpr Polycone<double> polycone{sections, 2, ledges, 3, -1, 1, 1.2, full};
constexpr SideNormal<double> sides[] = {{0.96, 0.28}, {-0.6, 0.8}, {-0.28, -0.96}, {0.8, -0.6}};
constexpr SideGroup<double> side_groups[] = {{{0.96, -0.6, -0.28, 0.8, 0.8, 0.8, 0.8, 0.8},
                                              {0.28, 0.8, -0.96, -0.6, -0.6, -0.6, -0.6, -0.6}}};
constexpr Polyhedra<double> polyhedra{sections, 2,    ledges, 3, -1,          1,
                                      1.6,      full, sides,  4, side_groups, 1};

constexpr Torus<double> torus{0.2, 0.4, 0.8, gapped};
constexpr QuadricSolid<double> ellipsoid{1.2, 0.7, -0.9, 0.8, {0.69, 2.04, 1, 0, -1, 0}, {}, 0};
constexpr QuadricSolid<double> hype{
    1.3, 1.3, -0.9, 0.9, {1, 1, -0.5, 0, -0.8, 0}, {1, 1, -0.1, 0, -0.1, 0}, 1};
constexpr TwistedTube<double> twisted_tube{1.4,
                                           -0.9,
                                           0.8,
                                           {1, 1, -0.5, 0, -1, 0},
                                           {1, 1, -0.05, 0, -0.1, 0},
                                           {-0.6, -0.8, 0.7},
                                           {-0.6, 0.8, 0.7}};
constexpr TwistedTrap<double> twisted_trap{0.9,
                                           0.7,
                                           0.1,
                                           -0.05,
                                           1.3,
                                           1.3,
                                           1.2,
                                           {0.96, -0.28, 0.6, 0.1},
                                           {-1, 0, 0.6, 0.1},
                                           {0, -1, 0.5, 0.2},
                                           {0, 1, 0.5, 0.2}};

/// Hides a value from the optimiser.
template <class T>
T opaque(T value) {
  asm volatile("" : : "r"(&value) : "memory");
  return value;
}
template <class Real>
Polycone<Real> hidden(const Polycone<Real>& s) {
  Polycone<Real> copy = opaque(s);
  static Section<Real> own_sections[2];
  static Ledge<Real> own_ledges[3];
  std::copy_n(s.sections, 2, own_sections);
  std::copy_n(s.ledges, 3, own_ledges);
  copy.sections = opaque(&own_sections[0]);
  copy.ledges = opaque(&own_ledges[0]);
  return copy;
}
template <class Real>
Hull<Real> hidden(const Hull<Real>& s) {
  static Plane<Real> own[5];
  static PlaneGroup<Real> own_groups[1];
  std::copy_n(s.planes, 5, own);
  std::copy_n(s.groups, 1, own_groups);
  return {opaque(&own[0]), opaque(s.count), opaque(&own_groups[0]), opaque(s.group_count)};
}
template <class Real>
Polyhedra<Real> hidden(const Polyhedra<Real>& s) {
  static SideGroup<Real> own[1];
  std::copy_n(s.groups, 1, own);
  Polyhedra<Real> copy = opaque(s);
  copy.groups = opaque(&own[0]);
  return copy;
}
template <class Real>
Facets<Real> hidden(const Facets<Real>& s) {
  static kernels::Vec3<Real> own[4];
  static FacetGroup<Real> own_groups[1];
  static FacetLeaf<Real> own_leaves[1];
  std::copy_n(s.corners, 4, own);
  std::copy_n(s.groups, 1, own_groups);
  std::copy_n(s.leaves, 1, own_leaves);
  Facets<Real> copy = opaque(s);
  copy.corners = opaque(&own[0]);
  copy.groups = opaque(&own_groups[0]);
  copy.leaves = opaque(&own_leaves[0]);
  return copy;
}
template <class Real>
Prism<Real> hidden(const Prism<Real>& s) {
  static PlanarCorner<Real> own[5];
  static CornerGroup<Real> own_groups[1];
  std::copy_n(s.corners, 5, own);
  std::copy_n(s.groups, 1, own_groups);
  Prism<Real> copy = opaque(s);
  copy.corners = opaque(&own[0]);
  copy.groups = opaque(&own_groups[0]);
  return copy;
}
template <class Shape>
Shape hidden(const Shape& s) {
  return opaque(s);
}

template <const auto& literal>
void compare() {
  const auto s = hidden(literal);
  Random random(51);
  const Extent around{{-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5}};
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  for (int i = 0; i < 20000; ++i) {
    const V p = random.point_in(around, 0.1);
    const D v = random.any_direction();
    ASSERT_EQ(inside(literal, p, 1e-9), inside(s, p, 1e-9));
    ASSERT_EQ(contains(literal, p, v, 1e-9), contains(s, p, v, 1e-9));
    ASSERT_EQ(bits(distance_to_in(literal, p, v, 1e-9)), bits(distance_to_in(s, p, v, 1e-9)));
    ASSERT_EQ(bits(distance_to_out(literal, p, v, 1e-9)), bits(distance_to_out(s, p, v, 1e-9)));
    ASSERT_EQ(bits(safety_to_in(literal, p)), bits(safety_to_in(s, p)));
    ASSERT_EQ(bits(safety_to_out(literal, p)), bits(safety_to_out(s, p)));
  }
}

TEST(KernelBits, AreThoseOfLiteralShapes) {
  compare<box>();
  compare<tube>();
  compare<gapped_tube>();
  compare<cone>();
  compare<trd>();
  compare<trap>();
  compare<hull>();
  compare<facets>();
  compare<prism>();
  compare<arb8>();
  compare<cut_tube>();
  compare<orb>();
  compare<sphere>();
  compare<polycone>();
  compare<polyhedra>();
  compare<torus>();
  compare<ellipsoid>();
  compare<hype>();
  compare<twisted_tube>();
  compare<twisted_trap>();
}

}  // namespace
}  // namespace navjit::test
