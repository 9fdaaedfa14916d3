// Shapes of ROOT's, those that are made of others among them.
#include <algorithm>
#include <cmath>

#include "geometry/root/reading.hpp"

namespace navjit::root {
namespace {

bool is_identity(const Frame& frame) {
  constexpr Frame identity;
  return std::ranges::equal(frame.translation, identity.translation) &&
         std::ranges::equal(frame.rotation, identity.rotation);
}

Solid placed(const Solid& solid, const Frame& frame) {
  if (is_identity(frame)) return solid;
  const Transformation t = transformation_of(frame);
  SolidFrame where;
  std::ranges::copy(t.translation, where.translation);
  std::ranges::copy(t.rotation, where.rotation);
  return make_placed(solid.name, solid, where);
}

double size_of(const Extent& e) { return norm(e.max - e.min) + std::max(norm(e.min), norm(e.max)); }

/// Half of space has no end. Of it a box is enough that reaches beyond the other operand: with one
/// face on the plane. The frames place both in the boolean.
Solid box_of_half_space(const Object& half, const Frame& frame, const Extent& other) {
  const std::span<const double> p = half.numbers("fP", 3), n = half.numbers("fN", 3);
  const double length = std::hypot(n[0], n[1], n[2]);
  if (!(length > 0)) half.fail("its plane has no direction");
  const Vec3 z{n[0] / length, n[1] / length, n[2] / length};
  // Any two directions across it.
  const Vec3 aside = std::abs(z.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  Vec3 x = aside - dot(aside, z) * z;
  x = (1 / norm(x)) * x;
  const Vec3 y{z.y * x.z - z.z * x.y, z.z * x.x - z.x * x.z, z.x * x.y - z.y * x.x};
  const Vec3 on{cm * p[0], cm * p[1], cm * p[2]};
  const double* t = frame.translation;
  const double reach = 2 * (size_of(other) + norm(on) + norm(Vec3{t[0], t[1], t[2]})) + 1;
  // Inside is where the normal points from.
  const Vec3 middle = on - reach * z;
  const Frame turned{{middle.x, middle.y, middle.z}, {x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z}};
  return placed(placed(make_box(half.name, reach, reach, reach), turned), frame);
}

bool is_half_space(Reading& reading, Reference shape) {
  return shape != 0 && reading.objects.at(shape).is("TGeoHalfSpace");
}

MadeSolid read_scaled(Reading& reading, const Object& shape, std::size_t depth) {
  const Object& scale = reading.objects.at(shape.reference("fScale"));
  const std::span<const double> factors = scale.numbers("fScale", 3);
  const MadeSolid& inner = read_solid(reading, shape.reference("fShape"), depth + 1);
  return {make_scaled(shape.name, inner.solid, factors[0], factors[1], factors[2]), inner.parts};
}

MadeSolid make(Reading& reading, const Object& shape, std::size_t depth) {
  if (depth > reading.limits.max_solid_depth) {
    shape.fail("shapes are nested more than " + std::to_string(reading.limits.max_solid_depth) +
               " deep; raise RootLimits::max_solid_depth if this is meant");
  }
  try {
    if (shape.is("TGeoCompositeShape")) return read_boolean(reading, shape, depth);
    if (shape.is("TGeoXtru")) return {read_extruded(reading, shape)};
    if (shape.is("TGeoScaledShape")) return read_scaled(reading, shape, depth);
    return {read_primitive(shape)};
  } catch (const GeometryError& e) {
    shape.fail(e.what());
  }
}

}  // namespace

MadeSolid read_boolean(Reading& reading, const Object& composite, std::size_t depth) {
  const Object& node = reading.objects.at(composite.reference("fNode"));
  const Reference left = node.reference("fLeft"), right = node.reference("fRight");
  if (left == 0 || right == 0) composite.fail("it lacks an operand");
  if (is_half_space(reading, left)) {
    composite.fail("unsupported: its first operand is half of space; make it the second");
  }
  const MadeSolid& first = read_solid(reading, left, depth + 1);
  const std::size_t first_parts = first.parts;
  const Solid a = placed(first.solid, read_frame(reading, node.reference("fLeftMat")));
  const Frame frame = read_frame(reading, node.reference("fRightMat"));
  std::size_t parts = first_parts + 1;
  Solid b;
  if (is_half_space(reading, right)) {
    if (node.is("TGeoUnion")) composite.fail("unsupported: a union with half of space has no end");
    b = box_of_half_space(reading.objects.at(right), frame, a.extent);
  } else {
    const MadeSolid& second = read_solid(reading, right, depth + 1);
    parts = first_parts + second.parts;
    b = placed(second.solid, frame);
  }
  // Each boolean looks at the parts of those within it again.
  constexpr std::size_t most_in_all = 5'000'000;
  reading.boolean_parts += parts;
  if (parts > reading.limits.max_solid_parts || reading.boolean_parts > most_in_all) {
    composite.fail("the boolean has more than " + std::to_string(reading.limits.max_solid_parts) +
                   " parts; split it, or raise RootLimits::max_solid_parts");
  }
  if (node.is("TGeoUnion")) return {make_union(composite.name, a, b), parts};
  if (node.is("TGeoSubtraction")) return {make_subtraction(composite.name, a, b), parts};
  if (node.is("TGeoIntersection")) return {make_intersection(composite.name, a, b), parts};
  composite.fail("unsupported operation " + node.type +
                 "; union, subtraction and intersection are read");
}

const MadeSolid& read_solid(Reading& reading, Reference reference, std::size_t depth) {
  const auto known = reading.solids.find(reference);
  if (known != reading.solids.end()) return known->second;
  MadeSolid made = make(reading, reading.objects.at(reference), depth);
  return reading.solids.insert_or_assign(reference, std::move(made)).first->second;
}

}  // namespace navjit::root
