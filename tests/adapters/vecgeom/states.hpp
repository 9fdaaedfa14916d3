// Random states of every volume of a detector, each in any of its touchables.
#pragma once

#include <algorithm>
#include <optional>
#include <random>
#include <vector>

#include "navjit/detector.hpp"
#include "navjit/navigator.hpp"

namespace navjit::tests {

/// Makes states of volumes, with a point in each.
class StateMaker {
 public:
  struct Made {
    State state;
    Vec3 point, direction;
  };

  StateMaker(const Detector& detector, Navigator& navigator, std::uint64_t seed)
      : detector_(detector), navigator_(navigator), random_(seed), mothers_(detector.volumes()) {
    for (VolumeId v = 0; v < detector.volumes(); ++v) {
      const LogicalVolume& volume = detector.volume(v);
      if (volume.touchables == 0) continue;
      for (std::uint32_t d = 0; d < volume.daughters.size(); ++d)
        mothers_[volume.daughters[d].volume].push_back({v, d});
    }
  }

  /// A random touchable of the volume, a random point in it and in none of its daughters, and a
  /// random direction; nothing after `tries` points.
  std::optional<Made> make(VolumeId volume, int tries = 50) {
    const State state = touchable_of(volume);
    const Extent& box = detector_.volume(volume).solid.extent;
    for (int i = 0; i < tries; ++i) {
      const Vec3 point =
          navigator_.to_global(state, {between(box.min.x, box.max.x), between(box.min.y, box.max.y),
                                       between(box.min.z, box.max.z)});
      if (navigator_.locate(point) == state) return Made{state, point, direction()};
    }
    return std::nullopt;
  }

  Vec3 direction() {
    std::normal_distribution<double> normal;
    while (true) {
      const Vec3 v{normal(random_), normal(random_), normal(random_)};
      const double length = norm(v);
      if (length > 1e-3) return (1 / length) * v;
    }
  }
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

 private:
  struct Mother {
    VolumeId volume;
    std::uint32_t daughter;
  };

  State touchable_of(VolumeId volume) {
    std::vector<std::uint32_t> path;
    while (volume != detector_.world_volume()) {
      const std::vector<Mother>& mothers = mothers_[volume];
      const Mother& mother = mothers[random_() % mothers.size()];
      path.push_back(mother.daughter);
      volume = mother.volume;
    }
    std::reverse(path.begin(), path.end());
    return detector_.state_at(path);
  }

  const Detector& detector_;
  Navigator& navigator_;
  std::mt19937_64 random_;
  std::vector<std::vector<Mother>> mothers_;
};

}  // namespace navjit::tests
