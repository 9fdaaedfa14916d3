// What the generic navigator asks of one daughter, or of one solid.
#pragma once

#include "geometry/navigation/packed_scenes.hpp"

namespace navjit::generic {

inline void push(NavigationStack& stack, const PackedDaughter& d, unsigned index) {
  const auto& [x, y, z] = d.translation;
  if (d.rotation == nullptr) {
    kernels::push_translated(&stack, d.volume, index, d.offset, x, y, z);
  } else {
    kernels::push_rotated(&stack, d.volume, index, d.offset, x, y, z, d.rotation);
  }
}

/// The point in the daughter's frame, except for the daughter's rotation.
inline Vec3 translated(const PackedDaughter& d, const Vec3& p) {
  return {p.x - d.translation[0], p.y - d.translation[1], p.z - d.translation[2]};
}
inline Vec3 rotated(const double* r, double x, double y, double z) {
  return {rotate_row(r, x, y, z), rotate_row(r + 3, x, y, z), rotate_row(r + 6, x, y, z)};
}
inline Vec3 local(const PackedDaughter& d, const Vec3& p) {
  const Vec3 q = translated(d, p);
  return d.rotation == nullptr ? q : rotated(d.rotation, q.x, q.y, q.z);
}

// Most volumes are boxes: their kernels are inlined here, before the switch over all kinds.

inline bool contains_here(const kernels::AnySolid<double>& solid, const Vec3& p, const Direction& v,
                          double tolerance) {
  if (solid.kind == SolidKind::box) {
    return contains(*static_cast<const kernels::Box<double>*>(solid.shape), p, v, tolerance);
  }
  return contains(solid, p, v, tolerance);
}

inline double distance_out_here(const kernels::AnySolid<double>& solid, const Vec3& p,
                                const Direction& v, double tolerance) {
  if (solid.kind == SolidKind::box) {
    return distance_to_out(*static_cast<const kernels::Box<double>*>(solid.shape), p, v, tolerance);
  }
  return distance_to_out(solid, p, v, tolerance);
}

/// The reciprocals of `v` are not read.
inline bool contains_local(const PackedDaughter& d, const Vec3& p, const Direction& v,
                           double tolerance) {
  const Vec3 q = translated(d, p);
  if (d.rotation == nullptr) return contains_here(d.solid, q, v, tolerance);
  const Vec3 u = rotated(d.rotation, v.x, v.y, v.z);
  return contains_here(d.solid, rotated(d.rotation, q.x, q.y, q.z),
                       kernels::make_heading(u.x, u.y, u.z), tolerance);
}

inline double distance_local(const PackedDaughter& d, const Vec3& p, const Direction& v,
                             double tolerance) {
  const Vec3 q = translated(d, p);
  if (d.rotation != nullptr) {
    const Vec3 u = rotated(d.rotation, v.x, v.y, v.z);
    return distance_to_in(d.solid, rotated(d.rotation, q.x, q.y, q.z),
                          kernels::make_direction(u.x, u.y, u.z), tolerance);
  }
  if (d.solid.kind == SolidKind::box) {
    return distance_to_in(*static_cast<const kernels::Box<double>*>(d.solid.shape), q, v,
                          tolerance);
  }
  return distance_to_in(d.solid, q, v, tolerance);
}

/// Whether daughter `k` of the innermost level contains the global point in its own frame. This and
/// the way through its mother's frame may differ in the last bit, and so in which side of a face a
/// ray along it is on. Writes to the place behind the innermost level.
struct InOwnFrame {
  NavigationStack& stack;
  const PackedScene& scene;
  const Vec3& point;
  const Direction& heading;  ///< in the world
  double tolerance;

  bool operator()(unsigned k) const {
    push(stack, scene.daughters[k], k);
    const StackLevel& level = stack.levels[stack.depth--];
    return contains_here(
        scene.daughters[k].solid, kernels::to_local(level, point.x, point.y, point.z),
        kernels::to_local_heading(level, heading.x, heading.y, heading.z), tolerance);
  }
};

}  // namespace navjit::generic
