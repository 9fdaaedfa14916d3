// Balls and spherical shells.
#include <algorithm>
#include <numbers>
#include <optional>

#include "geometry/solids/make.hpp"

namespace navjit {
namespace {

constexpr double pi = std::numbers::pi;

/// The convex one of the nappes at polar angle theta: around +z or around -z.
kernels::ConicalFace<double> polar_face(double theta, bool upper) {
  const detail::UnitVector u = detail::unit_vector(theta);
  return upper ? kernels::ConicalFace<double>{0, u.y, u.x}
               : kernels::ConicalFace<double>{0, -u.y, -u.x + 0.0};
}

}  // namespace

Solid make_orb(std::string name, double radius) {
  detail::require_finite({radius}, name);
  detail::require(radius > 0, name, "an orb needs a positive radius");
  return detail::make_solid(std::move(name), SolidKind::orb, kernels::Orb<double>{radius},
                            {{-radius, -radius, -radius}, {radius, radius, radius}});
}

Solid make_sphere(std::string name, double rmin, double rmax, double start_phi, double delta_phi,
                  double start_theta, double delta_theta) {
  detail::require_finite({rmin, rmax, start_theta, delta_theta}, name);
  detail::require(rmin >= 0 && rmax > rmin, name, "a sphere needs 0 <= rmin < rmax");
  detail::require(start_theta >= 0 && start_theta < pi, name,
                  "the polar start angle of a sphere must be at least 0 and below 180 degrees");
  detail::require(delta_theta > 0, name, "the polar angle spanned must be positive");
  const double end_theta = std::min(start_theta + delta_theta, pi);
  kernels::Sphere<double> shape{rmin, rmax, detail::make_wedge(start_phi, delta_phi, name), {}, {}};
  constexpr double negligible = 1e-12;
  const double middle = pi / 2;
  if (start_theta > negligible) {
    const bool upper = start_theta < middle - negligible;
    shape.low = {upper ? 2 : 1, polar_face(start_theta, upper)};
  }
  if (end_theta < pi - negligible) {
    const bool lower = end_theta > middle + negligible;
    shape.high = {lower ? 2 : 1, polar_face(end_theta, !lower)};
  }
  if (rmin == 0 && shape.wedge.kind == 0 && shape.low.kind == 0 && shape.high.kind == 0) {
    return make_orb(std::move(name), rmax);
  }
  const detail::UnitVector low = detail::unit_vector(start_theta);
  const detail::UnitVector high = detail::unit_vector(end_theta);
  const bool equator = start_theta <= middle && end_theta >= middle;
  const double widest = equator ? 1 : std::max(low.y, high.y);
  Extent e = detail::sector_extent(rmin * std::min(low.y, high.y), rmax * widest, start_phi,
                                   delta_phi, 0, 0);
  e.max.z = std::max(rmin * low.x, rmax * low.x);
  e.min.z = std::min(rmin * high.x, rmax * high.x);
  return detail::make_solid(std::move(name), SolidKind::sphere, shape, e);
}

double SolidFacts<kernels::Orb<double>>::volume(const Shape& s) {
  return 4 * pi / 3 * s.radius * s.radius * s.radius;
}

double SolidFacts<kernels::Orb<double>>::ball(const Shape& s) { return s.radius; }

std::optional<double> SolidFacts<kernels::Orb<double>>::error(const Shape& s,
                                                              const KernelUse& use) {
  return face_error::ball(s.radius, use);
}

double SolidFacts<kernels::Sphere<double>>::volume(const Shape& s) {
  const auto cosine = [](const kernels::PolarLimit<double>& limit, double none) {
    if (limit.kind == 0) return none;
    return limit.face.slope < 0 ? -limit.face.cosine : limit.face.cosine;
  };
  const double heights = cosine(s.low, 1) - cosine(s.high, -1);
  const double shell = (s.rmax - s.rmin) * (s.rmax * s.rmax + s.rmax * s.rmin + s.rmin * s.rmin);
  return detail::angle_of(s.wedge) / 3 * heights * shell;
}

Round SolidFacts<kernels::Sphere<double>>::round(const Shape& s) { return {0, s.rmax, s.wedge}; }

double SolidFacts<kernels::Sphere<double>>::ball(const Shape& s) { return s.rmax; }

std::optional<double> SolidFacts<kernels::Sphere<double>>::error(const Shape& s,
                                                                 const KernelUse& use) {
  if (s.low.kind != 0 || s.high.kind != 0) return std::nullopt;
  return std::max({face_error::ball(s.rmax, use), face_error::ball(s.rmin, use),
                   face_error::wedge(s.wedge, use)});
}

}  // namespace navjit
