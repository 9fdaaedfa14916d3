#include "bench/bvh_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "geometry/gdml/read_world.hpp"
#include "geometry/model/placed_extent.hpp"
#include "geometry/model/random.hpp"
#include "geometry/navigation/geometry.hpp"

namespace navjit::bench {
namespace {

std::vector<Extent> grid(std::size_t count) {
  std::vector<Extent> boxes;
  const auto n = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(count)) - 1e-9));
  const double pitch = 1000.0 / static_cast<double>(n), edge = 0.7 * pitch;
  for (std::size_t i = 0; i < count; ++i) {
    const auto low = [&](std::size_t k) { return -500 + pitch * static_cast<double>(k); };
    const Vec3 corner{low(i % n), low(i / n % n), low(i / n / n)};
    boxes.push_back({corner, {corner.x + edge, corner.y + edge, corner.z + edge}});
  }
  return boxes;
}

std::vector<Extent> stack(std::size_t count) {
  std::vector<Extent> boxes;
  const double pitch = 1000.0 / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double low = -500 + pitch * static_cast<double>(i);
    boxes.push_back({{-500, -500, low}, {500, 500, low + 0.9 * pitch}});
  }
  return boxes;
}

std::vector<Extent> mixed(std::size_t count) {
  std::mt19937_64 random(count);
  std::vector<Extent> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    // There are as many small boxes as large ones, on a logarithmic scale.
    const double edge = std::pow(10.0, uniform(random, 0, 2.5));
    const auto low = [&] { return uniform(random, -500, 500 - edge); };
    const Vec3 corner{low(), low(), low()};
    const auto size = [&] { return edge * uniform(random, 0.3, 1); };
    boxes.push_back({corner, {corner.x + size(), corner.y + size(), corner.z + size()}});
  }
  return boxes;
}

}  // namespace

std::vector<BoxScene> made_up_scenes(std::size_t count) {
  return {{"grid", grid(count)}, {"stack", stack(count)}, {"mixed", mixed(count)}};
}

std::vector<BoxScene> scenes_of(const std::string& file, std::size_t most) {
  const World world = read_world(file);
  std::vector<const LogicalVolume*> volumes;
  for (const LogicalVolume& volume : world.volumes) {
    if (volume.daughters.size() >= 4) volumes.push_back(&volume);
  }
  std::stable_sort(volumes.begin(), volumes.end(),
                   [](const LogicalVolume* a, const LogicalVolume* b) {
                     return a->daughters.size() > b->daughters.size();
                   });
  std::vector<BoxScene> scenes;
  for (const LogicalVolume* volume : volumes) {
    if (scenes.size() == most) break;
    // Several volumes with the same number of daughters are mostly copies, and tell nothing new.
    if (!scenes.empty() && scenes.back().boxes.size() == volume->daughters.size()) continue;
    BoxScene scene{std::filesystem::path(file).stem().string() + " " + volume->name, {}};
    for (const Placement& placement : volume->daughters) {
      scene.boxes.push_back(
          placed_extent(world.volumes[placement.volume].solid, placement.transformation));
    }
    scenes.push_back(std::move(scene));
  }
  return scenes;
}

Extent bounds(const std::vector<Extent>& boxes) {
  const double infinity = std::numeric_limits<double>::infinity();
  Vec3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  const auto include = [](double value, double& below, double& above) {
    if (!std::isfinite(value)) return;
    below = std::min(below, value);
    above = std::max(above, value);
  };
  for (const Extent& box : boxes) {
    for (const Vec3& p : {box.min, box.max}) {
      include(p.x, low.x, high.x);
      include(p.y, low.y, high.y);
      include(p.z, low.z, high.z);
    }
  }
  return {low, high};
}

}  // namespace navjit::bench
