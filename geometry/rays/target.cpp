#include "geometry/rays/target.hpp"

#include <algorithm>
#include <limits>

#include "navjit/errors.hpp"

namespace navjit {
namespace {

Vec3 point_of(const Extent& box, double u, double v, double w) {
  return {box.min.x + u * (box.max.x - box.min.x), box.min.y + v * (box.max.y - box.min.y),
          box.min.z + w * (box.max.z - box.min.z)};
}

/// The box around all daughters, so far as they are within their mother.
Extent around_daughters(const World& world, const LogicalVolume& mother) {
  const double infinity = std::numeric_limits<double>::infinity();
  Extent box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  for (const Placement& daughter : mother.daughters) {
    const Extent& own = world.volumes[daughter.volume].solid.extent;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p = to_outer(daughter.transformation,
                              point_of(own, corner & 1, (corner >> 1) & 1, (corner >> 2) & 1));
      box.min = {std::min(box.min.x, p.x), std::min(box.min.y, p.y), std::min(box.min.z, p.z)};
      box.max = {std::max(box.max.x, p.x), std::max(box.max.y, p.y), std::max(box.max.z, p.z)};
    }
  }
  const Extent& own = mother.solid.extent;
  if (mother.daughters.empty()) return own;
  return {{std::max(box.min.x, own.min.x), std::max(box.min.y, own.min.y),
           std::max(box.min.z, own.min.z)},
          {std::min(box.max.x, own.max.x), std::min(box.max.y, own.max.y),
           std::min(box.max.z, own.max.z)}};
}

}  // namespace

Target::Target(const World& world, const std::string& aim) : world_(world) {
  if (aim == "auto") {
    single_ = true;
    const TouchableId half = world.volumes[world.top].touchables / 2;
    VolumeId volume = world.top;
    for (const Placement* next = nullptr;; volume = next->volume) {
      const auto& daughters = world.volumes[volume].daughters;
      next = nullptr;
      for (const Placement& daughter : daughters) {
        if (world.volumes[daughter.volume].touchables > half) next = &daughter;
      }
      if (next == nullptr) break;
      frame_ = compose(frame_, next->transformation);
    }
    box_ = around_daughters(world, world.volumes[volume]);
    return;
  }
  const std::size_t volumes = world.volumes.size();
  aimed_at_.resize(volumes);
  below_.resize(volumes);
  sums_.resize(volumes);
  for (std::size_t v = 0; v < volumes; ++v) aimed_at_[v] = world.volumes[v].name == aim;
  std::vector<bool> counted(volumes);
  count(world.top, counted);
  if (below_[world.top] == 0) {
    throw Error("no logical volume in the world is called '" + aim +
                "', to aim at; navjit inspect lists them");
  }
}

void Target::count(VolumeId volume, std::vector<bool>& counted) {
  counted[volume] = true;
  std::vector<std::uint64_t> sums;
  std::uint64_t sum = aimed_at_[volume] ? 1 : 0;
  for (const Placement& daughter : world_.volumes[volume].daughters) {
    if (!counted[daughter.volume]) count(daughter.volume, counted);
    sums.push_back(sum += below_[daughter.volume]);
  }
  below_[volume] = sum;
  if (sum > 0) sums_[volume] = std::move(sums);
}

Vec3 Target::point(std::uint64_t box, double u, double v, double w) const {
  if (single_) return to_outer(frame_, point_of(box_, u, v, w));
  Transformation frame;
  VolumeId volume = world_.top;
  while (!(aimed_at_[volume] && box == 0)) {
    const std::vector<std::uint64_t>& sums = sums_[volume];
    const auto found = std::upper_bound(sums.begin(), sums.end(), box);
    const Placement& daughter =
        world_.volumes[volume].daughters[static_cast<std::size_t>(found - sums.begin())];
    box -= *found - below_[daughter.volume];
    frame = compose(frame, daughter.transformation);
    volume = daughter.volume;
  }
  return to_outer(frame, point_of(world_.volumes[volume].solid.extent, u, v, w));
}

}  // namespace navjit
