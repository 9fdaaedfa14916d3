// Rays: read from files, or made up.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/model/world.hpp"
#include "runtime/transport.hpp"

namespace navjit::common {

/// Reads `x,y,z,dx,dy,dz` (mm; header required; plain or gzip); directions are normalised. Throws
/// std::runtime_error with file and line on anything else.
std::vector<Ray> read_rays(const std::string& path);

struct RaySource {
  std::optional<Vec3> origin;                    ///< default: points spread over the world
  std::optional<std::pair<double, double>> eta;  ///< pseudorapidity about +z; default: isotropic
  std::uint64_t seed = 1;
};

/// Ray number `index` of a source: depends on nothing else, so that threads may share the work.
Ray make_ray(const RaySource& source, const World& world, std::uint64_t index);

/// The rays of a file, or so many of a source where `text` is a number. Throws std::runtime_error
/// as read_rays.
std::vector<Ray> rays_of(const std::string& text, const RaySource& source, const World& world);

}  // namespace navjit::common
