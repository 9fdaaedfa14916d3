// Makes rays up.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "geometry/model/world.hpp"
#include "geometry/rays/ray.hpp"
#include "geometry/rays/target.hpp"

namespace navjit {

/// Which rays are to be made.
struct RaySource {
  std::optional<Vec3> origin{};                    ///< default: points spread evenly over the world
  std::optional<std::pair<double, double>> eta{};  ///< pseudorapidity about +z; default: isotropic
  std::uint64_t seed = 1;
  /// A logical volume, or "auto": isotropic rays through points of its boxes (Target), from where
  /// they enter the world; then there is neither origin nor eta. Empty: the rays are not aimed.
  std::string aim{};
};

/// Makes rays up. A ray depends only on the source, the world and its number, so that any number of
/// threads makes the same rays, and none need be kept: each ray has a generator of its own
/// (splitmix64), which starts from the seed and the number.
class RayMaker {
 public:
  /// The world has to outlive the ray maker. Throws as Target does.
  RayMaker(const World& world, RaySource source);

  Ray ray(std::uint64_t number) const;

 private:
  template <class Random>
  Vec3 aimed_start(Random& random, const Vec3& direction) const;

  const World& world_;
  RaySource source_;
  std::optional<Target> target_;
};

}  // namespace navjit
