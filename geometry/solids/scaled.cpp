#include <algorithm>

#include "geometry/solids/make.hpp"

namespace navjit {

Solid make_scaled(std::string name, const Solid& solid, double x, double y, double z) {
  detail::require_finite({x, y, z, 1 / x, 1 / y, 1 / z}, name);
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
