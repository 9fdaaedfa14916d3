#include "apps/picture/view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "navjit/errors.hpp"

namespace navjit::picture {
namespace {

/// Around the detector, of what is seen.
constexpr double margin = 1.04;
constexpr double default_fov = 40;

Vec3 unit(const Vec3& v) {
  const double length = std::hypot(v.x, v.y, v.z);
  return {v.x / length, v.y / length, v.z / length};
}

/// From the middle to the eye.
Vec3 side_of(const std::string& from) {
  if (from == "corner") return unit({-0.75, 0.5, -0.62});
  const double sign = from.starts_with('-') ? -1 : 1;
  const char axis = from.size() == 2 ? from[1] : '\0';
  switch (axis) {
    case 'x':
      return {sign, 0, 0};
    case 'y':
      return {0, sign, 0};
    case 'z':
      return {0, 0, sign};
    default:
      throw UsageError("'" + from + "' is no side to look from: +x, -x, +y, -y, +z, -z or corner");
  }
}

void turn(View& view, const Vec3& forward, const std::optional<Vec3>& wanted_up) {
  view.forward = forward;
  const Vec3 up = wanted_up.value_or(std::abs(forward.y) > 0.999 ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
  const Vec3 right = cross(forward, up);
  if (!(norm(right) > 1e-9 * norm(up))) {
    throw UsageError("up is along the view: --up has to be another direction");
  }
  view.right = unit(right);
  view.up = unit(cross(view.right, view.forward));
}

/// So that both fit into a picture of that shape.
void fit(View& view, double half_width, double half_height, int width, int height) {
  const double aspect = static_cast<double>(height) / width;
  view.half_width = std::max(half_width, half_height / aspect);
  view.half_height = view.half_width * aspect;
}

}  // namespace

Vec3 corner_of(const Extent& box, int corner) {
  return {(corner & 1) != 0 ? box.max.x : box.min.x, (corner & 2) != 0 ? box.max.y : box.min.y,
          (corner & 4) != 0 ? box.max.z : box.min.z};
}

Ray View::ray(int x, int y, int width, int height) const {
  const double u = half_width * ((2.0 * x + 1) / width - 1);
  const double v = half_height * (1 - (2.0 * y + 1) / height);
  const Vec3 across = u * right + v * up;
  if (!perspective) return {eye + across, forward};
  return {eye, unit(forward + across)};
}

View view_of(const Extent& box, const World& world, const ViewOptions& options, int width,
             int height) {
  View view;
  const Vec3 middle = options.at.value_or(0.5 * (box.min + box.max));
  view.perspective = options.eye.has_value() || options.fov.has_value();
  Vec3 forward{0, 0, 0};
  if (options.eye) {
    forward = middle - *options.eye;
    if (!(norm(forward) > 0))
      throw UsageError("the eye is where it looks at: change --eye or --at");
    forward = unit(forward);
  } else {
    forward = -1 * side_of(options.from);
  }
  turn(view, forward, options.up);
  double half_width = 0, half_height = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 from_middle = corner_of(box, corner) - middle;
    half_width = std::max(half_width, std::abs(dot(from_middle, view.right)));
    half_height = std::max(half_height, std::abs(dot(from_middle, view.up)));
  }
  if (!view.perspective) {
    if (options.width) {
      half_width = *options.width / 2;
      half_height = 0;
    } else {
      half_width *= margin;
      half_height *= margin;
    }
    fit(view, half_width, half_height, width, height);
    // Before all of the world, and no farther: rounding grows with the distance.
    const Extent& all = world.volumes[world.top].solid.extent;
    double back = 0;
    for (int corner = 0; corner < 8; ++corner) {
      back = std::max(back, -dot(corner_of(all, corner) - middle, forward));
    }
    view.eye = middle - (1.01 * back) * forward;
    return view;
  }
  const double angle = options.fov.value_or(default_fov) * std::numbers::pi / 360;
  const double aspect = static_cast<double>(height) / width;
  view.half_width = std::tan(angle) / std::max(1.0, aspect);
  view.half_height = view.half_width * aspect;
  if (options.eye) {
    view.eye = *options.eye;
    return view;
  }
  // So far away that each corner is within the picture.
  double away = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 c = corner_of(box, corner) - middle;
    const double needed = std::max(std::abs(dot(c, view.right)) / view.half_width,
                                   std::abs(dot(c, view.up)) / view.half_height);
    away = std::max(away, margin * needed - dot(c, forward));
  }
  view.eye = middle - away * forward;
  return view;
}

}  // namespace navjit::picture
