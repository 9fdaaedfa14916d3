// Solids made of solids: a solid in a frame of its own, and the three booleans.
//
// Many holes or many welded parts come as chains, with one operand for each level. If it is asked
// level by level, a chain of n takes the time of n^2 operands for one distance. So a union of
// unions is remade as a balanced tree of parts that are close together, where the boxes of operands
// exclude most of the tree; and what is cut from a solid is cut as one union: ((A - B) - C) = A -
// (B + C). More than a few parts also have their boxes beside the tree, to be looked at eight at
// once. A moved union is the union of its moved parts: so chains may be moved link by link.
#include <algorithm>
#include <vector>

#include "geometry/solids/extent.hpp"
#include "geometry/solids/make.hpp"
#include "geometry/solids/moved_box.hpp"
#include "geometry/solids/union_parts.hpp"
#include "navjit/transformation.hpp"

namespace navjit {
namespace {

/// Keeps the operands alive as long as the shape that points to them.
template <class Shape>
struct Holder : Shape {
  Solid a, b;
};

/// The solid holds its shape by way of Holder; see make_boolean() and make_placed().
template <class Shape>
const Holder<Shape>& holder_of(const Solid& solid) {
  return static_cast<const Holder<Shape>&>(*static_cast<const Shape*>(solid.shape.get()));
}

template <class Shape>
std::shared_ptr<const void> hold(const Shape& shape, const Solid& a, const Solid& b) {
  auto holder = std::make_shared<const Holder<Shape>>(Holder<Shape>{shape, a, b});
  return {holder, static_cast<const Shape*>(holder.get())};
}

/// `boxed` says whether the box is worth a test of its own. For a solid that is a box it is not.
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
  const Shape shape{operand(a, first_boxed), operand(b, true)};
  return {std::move(name), kind, hold(shape, a, b), extent};
}

/// With fewer parts the tree is as fast: a guess.
constexpr std::size_t least_boxed_parts = 5;

struct UnionHolder : Holder<kernels::AnyUnion<double>> {
  kernels::UnionParts of_many;
};

std::shared_ptr<const void> hold_union(UnionHolder from) {
  auto holder = std::make_shared<UnionHolder>(std::move(from));
  holder->parts = &holder->of_many;
  return {holder, static_cast<const kernels::AnyUnion<double>*>(holder.get())};
}

bool is_identity(const double (&r)[9]) {
  constexpr double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  return std::equal(std::begin(r), std::end(r), identity);
}

using Union = kernels::AnyUnion<double>;
using Subtraction = kernels::AnySubtraction<double>;

void add_parts(const Solid& solid, std::vector<Solid>& parts) {
  if (solid.kind != SolidKind::union_of) {
    parts.push_back(solid);
    return;
  }
  add_parts(holder_of<Union>(solid).a, parts);
  add_parts(holder_of<Union>(solid).b, parts);
}

double centre(const Solid& solid, int axis) {
  const auto along = [&](const Vec3& v) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; };
  return along(solid.extent.min) / 2 + along(solid.extent.max) / 2;
}

/// The union of the parts, divided in two where they are furthest apart.
Solid balanced_union(std::string name, std::span<Solid> parts) {
  if (parts.size() == 1) return parts[0];
  int widest = 0;
  double width = -1;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax_element(
        parts.begin(), parts.end(),
        [&](const Solid& a, const Solid& b) { return centre(a, axis) < centre(b, axis); });
    const double apart = centre(*high, axis) - centre(*low, axis);
    if (apart > width) {
      width = apart;
      widest = axis;
    }
  }
  if (parts.size() > 2) {
    std::stable_sort(parts.begin(), parts.end(), [&](const Solid& a, const Solid& b) {
      return centre(a, widest) < centre(b, widest);
    });
  }
  const std::size_t half = parts.size() / 2;
  const Solid a = balanced_union(name, parts.first(half));
  const Solid b = balanced_union(name, parts.subspan(half));
  return make_boolean<Union>(std::move(name), SolidKind::union_of, a, b, merged(a.extent, b.extent),
                             true);
}

Solid union_of(std::string name, std::vector<Solid> parts) {
  Solid tree = balanced_union(std::move(name), parts);
  if (parts.size() < least_boxed_parts) return tree;
  std::vector<kernels::AnyOperand<double>> operands;
  for (const Solid& part : parts) operands.push_back(operand(part, true));
  UnionHolder holder{holder_of<Union>(tree), kernels::make_union_parts(parts, std::move(operands))};
  tree.shape = hold_union(std::move(holder));
  return tree;
}

using Placed = kernels::AnyPlaced<double>;

/// The frame of what `inner` places in what `outer` places.
SolidFrame composed(const SolidFrame& outer, const SolidFrame& inner) {
  const auto transformation = [](const SolidFrame& frame) {
    Transformation t{{}, {}, !is_identity(frame.rotation)};
    std::copy_n(frame.translation, 3, t.translation);
    std::copy_n(frame.rotation, 9, t.rotation);
    return t;
  };
  const Transformation both = compose(transformation(outer), transformation(inner));
  SolidFrame frame;
  std::copy_n(both.translation, 3, frame.translation);
  if (both.rotated) std::copy_n(both.rotation, 9, frame.rotation);
  return frame;
}

SolidFrame frame_of(const Placed& placed) {
  SolidFrame frame;
  std::copy_n(placed.translation, 3, frame.translation);
  std::copy_n(placed.rotation, 9, frame.rotation);
  return frame;
}

}  // namespace

Solid make_placed(std::string name, const Solid& solid, const SolidFrame& frame) {
  detail::require_shape(solid, name);
  try {
    make_transformation(frame.translation, frame.rotation);
  } catch (const GeometryError& error) {
    detail::require(false, name, error.what());
  }
  // One level instead of two. A moved union remains a part of the union that it is in.
  if (solid.kind == SolidKind::placed) {
    const auto& inner = holder_of<Placed>(solid);
    return make_placed(std::move(name), inner.a, composed(frame, frame_of(inner)));
  }
  if (solid.kind == SolidKind::union_of) {
    std::vector<Solid> parts;
    add_parts(solid, parts);
    for (Solid& part : parts) part = make_placed(part.name, part, frame);
    return union_of(std::move(name), std::move(parts));
  }
  kernels::AnyPlaced<double> shape{solid.any(), is_identity(frame.rotation) ? 0 : 1, {}, {}};
  std::copy_n(frame.translation, 3, shape.translation);
  std::copy_n(frame.rotation, 9, shape.rotation);
  return {std::move(name), SolidKind::placed, hold(shape, solid, solid),
          moved_box(solid.extent, frame.translation, frame.rotation)};
}

Solid make_union(std::string name, const Solid& a, const Solid& b) {
  for (const Solid* operand : {&a, &b}) detail::require_shape(*operand, name);
  std::vector<Solid> parts;
  add_parts(a, parts);
  add_parts(b, parts);
  return union_of(std::move(name), std::move(parts));
}

Solid make_intersection(std::string name, const Solid& a, const Solid& b) {
  for (const Solid* operand : {&a, &b}) detail::require_shape(*operand, name);
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
  for (const Solid* operand : {&a, &b}) detail::require_shape(*operand, name);
  if (a.kind == SolidKind::subtraction_of) {
    const auto& first = holder_of<Subtraction>(a);
    const Solid cut = make_union(name + "_cut", first.b, b);
    return make_subtraction(std::move(name), first.a, cut);
  }
  return make_boolean<Subtraction>(std::move(name), SolidKind::subtraction_of, a, b, a.extent,
                                   false);
}

}  // namespace navjit
