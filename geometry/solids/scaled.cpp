#include <algorithm>
#include <cmath>

#include "geometry/solids/make.hpp"

namespace navjit {

Solid make_scaled(std::string name, const Solid& solid, double x, double y, double z) {
  detail::require_shape(solid, name);
  detail::require_finite({x, y, z, 1 / x, 1 / y, 1 / z}, name);
  // Squares of what kernels compute with such factors must be finite, also if scaled solids are
  // scaled again.
  constexpr double most_factor = 1e30, most_edge = 1e60;
  for (const double factor : {std::abs(x), std::abs(y), std::abs(z)}) {
    detail::require(factor >= 1 / most_factor && factor <= most_factor, name,
                    "the factors of a scale must be between 1e-30 and 1e30");
  }
  const Extent& e = solid.extent;
  for (const double edge : {(e.max.x - e.min.x) * std::abs(x), (e.max.y - e.min.y) * std::abs(y),
                            (e.max.z - e.min.z) * std::abs(z)}) {
    detail::require(edge >= 1 / most_edge && edge <= most_edge, name,
                    "it would be scaled to a size that cannot be navigated");
  }
  struct Holder {
    kernels::AnyScaled<double> shape;
    Solid solid;
  };
  const double most = std::max({std::abs(1 / x), std::abs(1 / y), std::abs(1 / z)});
  const auto holder =
      std::make_shared<const Holder>(Holder{{solid.any(), 1 / x, 1 / y, 1 / z, most}, solid});
  const Vec3 a{solid.extent.min.x * x, solid.extent.min.y * y, solid.extent.min.z * z};
  const Vec3 b{solid.extent.max.x * x, solid.extent.max.y * y, solid.extent.max.z * z};
  return {std::move(name), SolidKind::scaled, std::shared_ptr<const void>(holder, &holder->shape),
          merged({a, a}, {b, b})};
}

}  // namespace navjit
