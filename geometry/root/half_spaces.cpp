// TGeoHalfSpace, and booleans of such. They have no end; but of an operand only what is near the
// other one counts: near to it a box with one face on the plane is the same as half of space.
#include <algorithm>
#include <cmath>

#include "geometry/root/composites.hpp"

namespace navjit::root {
namespace {

Vec3 turned(const Frame& frame, const Vec3& v) {
  const double* r = frame.rotation;
  return {r[0] * v.x + r[1] * v.y + r[2] * v.z, r[3] * v.x + r[4] * v.y + r[5] * v.z,
          r[6] * v.x + r[7] * v.y + r[8] * v.z};
}

Vec3 moved(const Frame& frame, const Vec3& p) {
  const double* t = frame.translation;
  return turned(frame, p) + Vec3{t[0], t[1], t[2]};
}

Frame compose(const Frame& outer, const Frame& inner) {
  const double *a = outer.rotation, *b = inner.rotation, *t = inner.translation;
  const Vec3 middle = moved(outer, {t[0], t[1], t[2]});
  Frame both{{middle.x, middle.y, middle.z}};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      both.rotation[3 * i + j] =
          a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
    }
  }
  return both;
}

/// The box goes from the plane to beyond the region, and aside by as much.
Solid box_of(const Object& half, const Frame& frame, const Extent& region) {
  const std::span<const double> p = half.numbers("fP", 3), n = half.numbers("fN", 3);
  const double length = std::hypot(n[0], n[1], n[2]);
  if (!(length > 0)) half.fail("its plane has no direction");
  const Vec3 z = turned(frame, {n[0] / length, n[1] / length, n[2] / length});
  const Vec3 on = moved(frame, {cm * p[0], cm * p[1], cm * p[2]});
  // Any two directions across it.
  const Vec3 aside = std::abs(z.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  Vec3 x = aside - dot(aside, z) * z;
  x = (1 / norm(x)) * x;
  const Vec3 y{z.y * x.z - z.z * x.y, z.z * x.x - z.x * x.z, z.x * x.y - z.y * x.x};
  // Planes beyond the region are all the same.
  const Vec3 centre = 0.5 * (region.min + region.max);
  const double around = norm(region.max - region.min);
  const double away = std::clamp(dot(on - centre, z), -around, around);
  const double reach = 2 * around;
  // Inside is where the normal points from.
  const Vec3 middle = centre + (away - reach) * z;
  return placed(make_box(half.name, reach, reach, reach),
                {{middle.x, middle.y, middle.z}, {x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z}});
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

Operand read_within(Reading& reading, Reference reference, const Frame& frame, const Extent& region,
                    std::size_t depth) {
  const Object& shape = reading.objects.at(reference);
  if (!is_endless(reading, reference, depth)) {
    return operand(read_solid(reading, reference, depth), frame);
  }
  check_nesting(reading, shape, depth);
  check_size(reading, shape, {});
  if (shape.is("TGeoHalfSpace")) return {box_of(shape, frame, region)};
  const Composite parts = parts_of(reading, shape);
  const auto within = [&](Reference part, Reference matrix) {
    return read_within(reading, part, compose(frame, read_frame(reading, matrix)), region,
                       depth + 1);
  };
  const Operand a = within(parts.left, parts.left_matrix);
  const Operand b = within(parts.right, parts.right_matrix);
  const MadeSolid made = combine(reading, shape, parts.operation, a, b);
  return {made.solid, made.size};
}

}  // namespace navjit::root
