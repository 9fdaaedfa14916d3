#include "bench/floor.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "geometry/navigation/generic.hpp"
#include "navjit/detail/standing.hpp"

namespace navjit::bench {
namespace {

bool same_bits(const Direction& a, const Direction& b) {
  using Bits = std::array<std::uint64_t, sizeof(Direction) / sizeof(std::uint64_t)>;
  return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}

}  // namespace

Floor::Floor(const Geometry& geometry, const std::vector<Ray>& rays)
    : tolerance_(geometry.tolerance()) {
  NavigationStack stack{};
  for (const Ray& ray : rays) {
    generic::locate(geometry, stack, ray.position, ray.direction);
    Vec3 point = ray.position;
    const std::size_t first_direction = directions_.size();
    detail::Standing standing;
    while (stack.depth >= 0 && !standing.stuck()) {
      const int depth = stack.depth;
      const StackLevel from = stack.levels[depth];
      const Scene& scene = geometry.scene(from.volume);
      // Copied, since the frame of `from` is lost once the stack has moved on.
      std::array<double, 9> turned{};
      if (from.rotation != nullptr) std::copy_n(from.rotation, 9, turned.begin());
      const double length = generic::step(geometry, stack, point, ray.direction,
                                          std::numeric_limits<double>::infinity());
      standing.count(length, tolerance_);
      RecordedStep step{};
      const bool in = stack.depth > depth && stack.levels[depth].touchable == from.touchable;
      const StackLevel& level = in ? stack.levels[depth + 1] : from;
      step.out = !in;
      step.volume = from.volume;
      step.solid = in ? scene.daughters[level.daughter].solid : scene.solid;
      std::copy_n(level.translation, 3, step.translation);
      if (level.rotation != nullptr) {
        if (in) std::copy_n(level.rotation, 9, turned.begin());
        if (rotations_.empty() || rotations_.back() != turned) rotations_.push_back(turned);
        step.rotation = rotations_.back().data();
      }
      StackLevel frame{};
      frame.rotation = step.rotation;
      const Direction direction =
          kernels::to_local_direction(frame, ray.direction.x, ray.direction.y, ray.direction.z);
      if (directions_.size() == first_direction || !same_bits(directions_.back(), direction)) {
        directions_.push_back(direction);
      }
      step.direction = &directions_.back();
      steps_.push_back(step);
      point = point + length * ray.direction;
    }
    starts_.push_back({ray, steps_.size()});
  }
}

double Floor::run() const {
  double total = 0;
  std::size_t i = 0;
  for (const Start& start : starts_) {
    double x = start.ray.position.x, y = start.ray.position.y, z = start.ray.position.z;
    const Vec3 d = start.ray.direction;
    for (; i < start.end; ++i) {
      const RecordedStep& step = steps_[i];
      const double dx = x - step.translation[0], dy = y - step.translation[1],
                   dz = z - step.translation[2];
      Vec3 p{dx, dy, dz};
      if (const double* r = step.rotation) {
        p = {r[0] * dx + r[1] * dy + r[2] * dz, r[3] * dx + r[4] * dy + r[5] * dz,
             r[6] * dx + r[7] * dy + r[8] * dz};
      }
      double length;
      if (step.solid.kind == SolidKind::box) {
        const auto& box = *static_cast<const kernels::Box<double>*>(step.solid.shape);
        length = step.out ? distance_to_out(box, p, *step.direction, tolerance_)
                          : distance_to_in(box, p, *step.direction, tolerance_);
      } else {
        length = step.out ? distance_to_out(step.solid, p, *step.direction, tolerance_)
                          : distance_to_in(step.solid, p, *step.direction, tolerance_);
      }
      if (!std::isfinite(length)) length = 0;  // rounding missed an edge: the next step adds it
      total += length;
      x += length * d.x;
      y += length * d.y;
      z += length * d.z;
    }
  }
  return total;
}

}  // namespace navjit::bench
