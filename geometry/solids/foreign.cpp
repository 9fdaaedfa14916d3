#include "geometry/solids/foreign.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/solids/make.hpp"

namespace navjit::foreign {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// After so many tolerances a ray has left the surface that it started on, or is on another one.
constexpr double away = 8;
/// A ray that grazes a curved surface stays on it longer: the way is doubled up to so often.
constexpr int most_doublings = 16;

/// A length that is not a number, or negative, counts as 0.
double length(double x) { return x > 0 ? x : 0; }

Vec3 moved(const Vec3& p, const Vec3& v, double t) { return p + t * v; }

/// Where a ray is when it has left the surface that it starts on.
struct Beyond {
  double way;  ///< mm
  PointSide side;
};
Beyond beyond_surface(const ForeignShape& s, const Vec3& p, const Vec3& v) {
  double way = away * s.tolerance;
  for (int i = 0; i < most_doublings; ++i, way *= 2) {
    const PointSide side = s.solid->inside(moved(p, v, way));
    if (side != PointSide::surface) return {way, side};
  }
  return {way, PointSide::surface};
}

/// For a point on the surface. The normal is that of one face: at an edge that turns inwards, a
/// direction out of that face may still head into the solid; at others one into it may head out.
bool heads_in(const ForeignShape& s, const Vec3& p, const Vec3& v) {
  if (v == Vec3{0, 0, 0}) return true;
  if (dot(s.solid->normal(p), v) > kernels::along_a_face<double>()) {
    return s.solid->distance_to_in(p, v) <= s.tolerance &&
           beyond_surface(s, p, v).side == PointSide::inside;
  }
  return s.solid->distance_to_out(p, v) > s.tolerance;
}

/// For a start on the surface with a direction that heads out.
double distance_from_surface(const ForeignShape& s, const Vec3& p, const Vec3& v) {
  const double distance = s.solid->distance_to_in(p, v);
  if (distance > s.tolerance) return distance;
  // The solid reports the surface that the ray is leaving as one that it comes to.
  const Beyond beyond = beyond_surface(s, p, v);
  if (beyond.side == PointSide::inside) return beyond.way;
  if (beyond.side == PointSide::surface) return infinite;
  return beyond.way + length(s.solid->distance_to_in(moved(p, v, beyond.way), v));
}

}  // namespace

kernels::Side inside(const ForeignShape& s, const Vec3& p) {
  return static_cast<kernels::Side>(s.solid->inside(p));
}

bool contains(const ForeignShape& s, const Vec3& p, const Vec3& v) {
  const PointSide side = s.solid->inside(p);
  return side == PointSide::surface ? heads_in(s, p, v) : side == PointSide::inside;
}

double distance_to_in(const ForeignShape& s, const Vec3& p, const Vec3& v) {
  switch (s.solid->inside(p)) {
    case PointSide::inside:
      return infinite;
    case PointSide::surface:
      return heads_in(s, p, v) ? 0 : distance_from_surface(s, p, v);
    default:
      return length(s.solid->distance_to_in(p, v));
  }
}

double distance_to_out(const ForeignShape& s, const Vec3& p, const Vec3& v) {
  const double distance = s.solid->distance_to_out(p, v);
  if (distance > s.tolerance) return distance;
  const PointSide side = s.solid->inside(p);
  if (side == PointSide::inside) return length(distance);
  if (side == PointSide::outside || !heads_in(s, p, v)) return 0;
  // It heads in nevertheless, at an edge that turns inwards.
  const double way = beyond_surface(s, p, v).way;
  return way + length(s.solid->distance_to_out(moved(p, v, way), v));
}

double safety_to_in(const ForeignShape& s, const Vec3& p) {
  return length(s.solid->safety_to_in(p));
}

double safety_to_out(const ForeignShape& s, const Vec3& p) {
  return length(s.solid->safety_to_out(p));
}

Vec3 normal(const ForeignShape& s, const Vec3& p) {
  const Vec3 n = s.solid->normal(p);
  const double size = norm(n);
  return size > 0 ? 1 / size * n : Vec3{0, 0, 1};
}

}  // namespace navjit::foreign

namespace navjit {
static_assert(static_cast<int>(PointSide::outside) == static_cast<int>(kernels::Side::outside) &&
              static_cast<int>(PointSide::surface) == static_cast<int>(kernels::Side::surface) &&
              static_cast<int>(PointSide::inside) == static_cast<int>(kernels::Side::inside));

Solid make_foreign(std::string name, std::shared_ptr<const ForeignSolid> solid,
                   const Extent& extent) {
  detail::require(solid != nullptr, name, "a foreign solid needs something that answers for it");
  const auto& [min, max] = extent;
  detail::require_finite({min.x, min.y, min.z, max.x, max.y, max.z}, name);
  detail::require(min.x < max.x && min.y < max.y && min.z < max.z, name,
                  "the box of a foreign solid has no inside");
  const double tolerance = solid->tolerance();
  detail::require(tolerance >= 0 && std::isfinite(tolerance), name,
                  "the tolerance of a foreign solid is no length");
  struct Holder {
    kernels::ForeignShape shape;
    std::shared_ptr<const ForeignSolid> solid;
  };
  const auto holder =
      std::make_shared<const Holder>(Holder{{solid.get(), tolerance}, std::move(solid)});
  return {std::move(name), SolidKind::foreign, std::shared_ptr<const void>(holder, &holder->shape),
          extent};
}

}  // namespace navjit
