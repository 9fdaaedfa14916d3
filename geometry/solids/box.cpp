#include <algorithm>
#include <optional>

#include "geometry/solids/make.hpp"

namespace navjit {

Solid make_box(std::string name, double hx, double hy, double hz) {
  detail::require_finite({hx, hy, hz}, name);
  detail::require(hx > 0 && hy > 0 && hz > 0, name, "a box needs positive lengths");
  return detail::make_solid(std::move(name), SolidKind::box, kernels::Box<double>{hx, hy, hz},
                            {{-hx, -hy, -hz}, {hx, hy, hz}});
}

double SolidFacts<kernels::Box<double>>::volume(const Shape& s) { return 8 * s.hx * s.hy * s.hz; }

std::optional<double> SolidFacts<kernels::Box<double>>::error(const Shape& s,
                                                              const KernelUse& use) {
  return face_error::slab(std::max({s.hx, s.hy, s.hz}), use);
}

}  // namespace navjit
