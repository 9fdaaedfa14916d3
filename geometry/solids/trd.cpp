#include <algorithm>
#include <optional>

#include "geometry/solids/make.hpp"

namespace navjit {
namespace {

/// The two sides: |u| = h1 at -hz and |u| = h2 at +hz.
kernels::FacePair<double> face_pair(double h1, double h2, double hz) {
  const kernels::ConicalFace<double> face = detail::conical_face(h1, h2, 2 * hz);
  return {face.cosine, -face.slope, face.cosine * ((h1 + h2) / 2)};
}

}  // namespace

Solid make_trd(std::string name, double hx1, double hx2, double hy1, double hy2, double hz) {
  detail::require_finite({hx1, hx2, hy1, hy2, hz}, name);
  detail::require(hx1 >= 0 && hx2 >= 0 && hy1 >= 0 && hy2 >= 0, name,
                  "a trd needs lengths that are not negative");
  detail::require((hx1 > 0 || hx2 > 0) && (hy1 > 0 || hy2 > 0), name,
                  "a trd needs a positive length at one end in x and in y");
  detail::require(hz > 0, name, "a trd needs a positive length in z");
  if (hx1 == hx2 && hy1 == hy2) return make_box(std::move(name), hx1, hy1, hz);
  const kernels::Trd<double> shape{hz, face_pair(hx1, hx2, hz), face_pair(hy1, hy2, hz)};
  const double hx = std::max(hx1, hx2), hy = std::max(hy1, hy2);
  return detail::make_solid(std::move(name), SolidKind::trd, shape,
                            {{-hx, -hy, -hz}, {hx, hy, hz}});
}

double SolidFacts<kernels::Trd<double>>::volume(const Shape& s) {
  // Half lengths in x and y are linear in z.
  const auto half = [](const kernels::FacePair<double>& f, double z) {
    return (f.offset - f.along * z) / f.across;
  };
  const double x = half(s.x, 0), y = half(s.y, 0);
  const double dx = half(s.x, s.hz) - x, dy = half(s.y, s.hz) - y;
  return 8 * s.hz * (x * y + dx * dy / 3);
}

std::optional<double> SolidFacts<kernels::Trd<double>>::error(const Shape& s,
                                                              const KernelUse& use) {
  return std::max({face_error::slab(s.hz, use), face_error::plane(s.x.offset, use),
                   face_error::plane(s.y.offset, use)});
}

}  // namespace navjit
