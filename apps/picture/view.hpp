// From where a picture is taken: a ray for each pixel.
#pragma once

#include <optional>
#include <string>

#include "geometry/model/world.hpp"
#include "runtime/transport.hpp"

namespace navjit::picture {

/// Parallel rays, or rays from one eye. All vectors are of unit length and at right angles.
struct View {
  bool perspective = false;
  Vec3 eye{0, 0, 0};  ///< or the middle of the plane on which parallel rays begin; mm
  Vec3 right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1};
  /// Half of what is seen: mm across parallel rays, or tangents of angles.
  double half_width = 1, half_height = 1;

  /// Through the middle of a pixel; (0, 0) is the top left one.
  Ray ray(int x, int y, int width, int height) const;
};

/// One of eight, 0 to 7.
Vec3 corner_of(const Extent& box, int corner);

/// What a view is asked to be.
struct ViewOptions {
  /// From where one looks: "+x", "-x", "+y", "-y", "+z", "-z", or "corner".
  std::string from = "corner";
  std::optional<Vec3> eye{};      ///< instead of that; perspective then
  std::optional<Vec3> at{};       ///< what is in the middle; default: the middle of the box
  std::optional<Vec3> up{};       ///< default: +y, or +x where one looks along y
  std::optional<double> fov{};    ///< degrees, of the wider side; asks for perspective
  std::optional<double> width{};  ///< mm across, of parallel rays; default: as the box needs
};

/// The view of a box, which is seen as a whole unless the options say otherwise, in a picture of so
/// many pixels. Throws UsageError if no view is to be had: an eye where it looks at, or an `up`
/// along the view.
View view_of(const Extent& box, const World& world, const ViewOptions& options, int width,
             int height);

}  // namespace navjit::picture
