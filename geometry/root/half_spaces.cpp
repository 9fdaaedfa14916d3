// TGeoHalfSpace, and booleans of such. They are infinite; but of an operand only what is near the
// other one counts. There, a box with one face on the plane is the same as a half space.
#include <algorithm>
#include <cmath>

#include "geometry/root/composites.hpp"

namespace navjit::root {
namespace {

/// The box reaches from the plane to beyond the region, and as far to the sides.
Solid box_of(const Object& half, const Transformation& at, const Extent& region) {
  const std::span<const double> p = half.numbers("fP", 3), n = half.numbers("fN", 3);
  const double length = std::hypot(n[0], n[1], n[2]);
  if (!(length > 0)) half.fail("its plane has no direction");
  const Vec3 z = direction_to_outer(at, {n[0] / length, n[1] / length, n[2] / length});
  const Vec3 on = to_outer(at, {cm * p[0], cm * p[1], cm * p[2]});
  // Any two directions across it will do.
  const Vec3 aside = std::abs(z.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  Vec3 x = aside - dot(aside, z) * z;
  x = (1 / norm(x)) * x;
  const Vec3 y{z.y * x.z - z.z * x.y, z.z * x.x - z.x * x.z, z.x * x.y - z.y * x.x};
  // Planes beyond the region all have the same effect there.
  const Vec3 centre = 0.5 * (region.min + region.max);
  const double around = norm(region.max - region.min);
  const double away = std::clamp(dot(on - centre, z), -around, around);
  const double reach = 2 * around;
  // The inside is where the normal comes from.
  const Vec3 middle = centre + (away - reach) * z;
  return make_placed(
      half.name, make_box(half.name, reach, reach, reach),
      {{middle.x, middle.y, middle.z}, {x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z}});
}

bool find_endless(Reading& reading, const Object& shape, std::size_t depth) {
  if (shape.is("TGeoHalfSpace")) return true;
  if (!shape.is("TGeoCompositeShape")) return false;
  check_nesting(reading, shape, depth);
  const Composite parts = parts_of(reading, shape);
  const bool left = is_endless(reading, parts.left, depth + 1);
  if (parts.operation == Boolean::cut) return left;
  const bool right = is_endless(reading, parts.right, depth + 1);
  return parts.operation == Boolean::join ? left || right : left && right;
}

}  // namespace

bool is_endless(Reading& reading, Reference shape, std::size_t depth) {
  const auto known = reading.endless.find(shape);
  if (known != reading.endless.end()) return known->second;
  const bool found = find_endless(reading, reading.objects.at(shape), depth);
  return reading.endless[shape] = found;
}

Operand read_within(Reading& reading, Reference reference, const Transformation& at,
                    const Extent& region, std::size_t depth) {
  const Object& shape = reading.objects.at(reference);
  if (!is_endless(reading, reference, depth)) {
    return operand(read_solid(reading, reference, depth), at);
  }
  check_nesting(reading, shape, depth);
  check_size(reading, shape, {});
  if (shape.is("TGeoHalfSpace")) return {box_of(shape, at, region)};
  const Composite parts = parts_of(reading, shape);
  const auto within = [&](Reference part, Reference matrix) {
    return read_within(reading, part, compose(at, transformation_at(reading, matrix)), region,
                       depth + 1);
  };
  const Operand a = within(parts.left, parts.left_matrix);
  const Operand b = within(parts.right, parts.right_matrix);
  const MadeSolid made = combine(reading, shape, parts.operation, a, b);
  return {made.solid, made.size};
}

}  // namespace navjit::root
