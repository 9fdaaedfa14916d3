#include "geometry/solids/bodies.hpp"

namespace navjit::detail {
namespace {

struct Holder {
  std::vector<kernels::PlanarCorner<double>> corners;
  std::vector<kernels::CornerGroup<double>> groups;
  kernels::Prism<double> shape;
};

}  // namespace

Solid make_prism(std::string name, std::span<const Vec3> corners, double z_low, double z_high) {
  const auto holder = std::make_shared<Holder>();
  Extent e{corners[0], corners[0]};
  for (const Vec3& p : corners) {
    holder->corners.push_back({p.x, p.y});
    e = merged(e, {p, p});
  }
  for (std::size_t i = 0; i < corners.size(); i += 8) {
    holder->groups.push_back(
        {eight_from(i, corners.size(), [&](std::size_t k) { return corners[k].x; }),
         eight_from(i, corners.size(), [&](std::size_t k) { return corners[k].y; })});
  }
  e.min.z = z_low;
  e.max.z = z_high;
  holder->shape = {holder->corners.data(),
                   static_cast<int>(holder->corners.size()),
                   holder->groups.data(),
                   static_cast<int>(holder->groups.size()),
                   z_low,
                   z_high,
                   e.min.x,
                   e.max.x,
                   e.min.y,
                   e.max.y};
  return {std::move(name), SolidKind::prism, std::shared_ptr<const void>(holder, &holder->shape),
          e};
}

}  // namespace navjit::detail

namespace navjit {

double SolidFacts<kernels::Prism<double>>::volume(const Shape& s) {
  const kernels::PlanarCorner<double>& o = s.corners[0];
  double twice_area = 0;
  for (int i = 2; i < s.count; ++i) {
    const kernels::PlanarCorner<double>&a = s.corners[i - 1], &b = s.corners[i];
    twice_area += (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
  }
  return twice_area / 2 * (s.z_high - s.z_low);
}

}  // namespace navjit
