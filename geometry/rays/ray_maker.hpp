// Rays made up.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "geometry/model/world.hpp"
#include "geometry/rays/ray.hpp"
#include "geometry/rays/target.hpp"

namespace navjit {

/// Which rays are made up.
struct RaySource {
  std::optional<Vec3> origin{};                    ///< default: points spread over the world
  std::optional<std::pair<double, double>> eta{};  ///< pseudorapidity about +z; default: isotropic
  std::uint64_t seed = 1;
  /// A logical volume, or "auto": isotropic rays through points of its boxes (Target), from where
  /// they enter the world. Neither origin nor eta then. Empty: not aimed.
  std::string aim{};
};

/// Makes rays up. A ray depends on the source, the world and its number alone, so that any number
/// of threads makes the same rays, and none is kept: each begins a generator of its own
/// (splitmix64) from the seed and the number.
class RayMaker {
 public:
  /// The world has to outlive it. Throws as Target.
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
