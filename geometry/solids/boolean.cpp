// Solids made of solids: a solid in a frame of its own, and the three booleans.
#include <algorithm>
#include <cmath>

#include "geometry/solids/extent.hpp"
#include "geometry/solids/make.hpp"

namespace navjit {
namespace {

/// Keeps the operands alive as long as the shape that points to them.
template <class Shape>
struct Holder {
  Shape shape;
  Solid a, b;
};

/// `boxed`: whether the box is worth a test of its own. For a box it is not.
kernels::AnyOperand<double> operand(const Solid& solid, bool boxed) {
  const Vec3 &low = solid.extent.min, &high = solid.extent.max;
  const double margin = 1e-9 * largest_coordinate(solid.extent);
  return {solid.any(),
          boxed && solid.kind != SolidKind::box ? 1 : 0,
          {low.x - margin, low.y - margin, low.z - margin},
          {high.x + margin, high.y + margin, high.z + margin}};
}

/// `first_boxed`: the first operand may be much smaller than the boolean.
template <class Shape>
Solid make_boolean(std::string name, SolidKind kind, const Solid& a, const Solid& b,
                   const Extent& extent, bool first_boxed) {
  auto holder = std::make_shared<const Holder<Shape>>(
      Holder<Shape>{{operand(a, first_boxed), operand(b, true)}, a, b});
  return {std::move(name), kind, std::shared_ptr<const void>(holder, &holder->shape), extent};
}

bool is_identity(const double (&r)[9]) {
  constexpr double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  return std::equal(std::begin(r), std::end(r), identity);
}

}  // namespace

Solid make_placed(std::string name, const Solid& solid, const SolidFrame& frame) {
  for (const double x : frame.translation) detail::require_finite({x}, name);
  for (const double x : frame.rotation) detail::require_finite({x}, name);
  kernels::AnyPlaced<double> shape{solid.any(), is_identity(frame.rotation) ? 0 : 1, {}, {}};
  std::copy_n(frame.translation, 3, shape.translation);
  std::copy_n(frame.rotation, 9, shape.rotation);
  // The box around the transformed box: centre moved, half lengths through |rotation|.
  const Extent& e = solid.extent;
  const double centre[3] = {(e.min.x + e.max.x) / 2, (e.min.y + e.max.y) / 2,
                            (e.min.z + e.max.z) / 2};
  const double half[3] = {(e.max.x - e.min.x) / 2, (e.max.y - e.min.y) / 2,
                          (e.max.z - e.min.z) / 2};
  double low[3], high[3];
  for (int i = 0; i < 3; ++i) {
    double c = frame.translation[i], h = 0;
    for (int j = 0; j < 3; ++j) {
      c += frame.rotation[3 * j + i] * centre[j];
      h += std::abs(frame.rotation[3 * j + i]) * half[j];
    }
    low[i] = c - h;
    high[i] = c + h;
  }
  using Shape = kernels::AnyPlaced<double>;
  auto holder = std::make_shared<const Holder<Shape>>(Holder<Shape>{shape, solid, solid});
  return {std::move(name), SolidKind::placed, std::shared_ptr<const void>(holder, &holder->shape),
          Extent{{low[0], low[1], low[2]}, {high[0], high[1], high[2]}}};
}

Solid make_union(std::string name, const Solid& a, const Solid& b) {
  const Extent e = merged(a.extent, b.extent);
  return make_boolean<kernels::AnyUnion<double>>(std::move(name), SolidKind::union_of, a, b, e,
                                                 true);
}

Solid make_intersection(std::string name, const Solid& a, const Solid& b) {
  const Extent e{
      {std::max(a.extent.min.x, b.extent.min.x), std::max(a.extent.min.y, b.extent.min.y),
       std::max(a.extent.min.z, b.extent.min.z)},
      {std::min(a.extent.max.x, b.extent.max.x), std::min(a.extent.max.y, b.extent.max.y),
       std::min(a.extent.max.z, b.extent.max.z)}};
  detail::require(e.min.x < e.max.x && e.min.y < e.max.y && e.min.z < e.max.z, name,
                  "the operands of the intersection do not meet");
  return make_boolean<kernels::AnyIntersection<double>>(std::move(name), SolidKind::intersection_of,
                                                        a, b, e, true);
}

Solid make_subtraction(std::string name, const Solid& a, const Solid& b) {
  return make_boolean<kernels::AnySubtraction<double>>(std::move(name), SolidKind::subtraction_of,
                                                       a, b, a.extent, false);
}

}  // namespace navjit
