#include "apps/picture/visible.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>

#include "apps/picture/view.hpp"
#include "navjit/errors.hpp"

namespace navjit::picture {
namespace {

/// Less than any solid or liquid, and more than the gases of detectors.
constexpr double densest_gas = 0.02;

bool matches(const std::string& pattern, const std::string& name) {
  return fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

/// Sets `flags` of volumes whose own or whose material's name matches. Whether there is one.
bool mark(const World& world, const std::string& pattern, bool value, bool with_materials,
          std::vector<bool>& flags) {
  bool found = false;
  for (std::size_t v = 0; v < world.volumes.size(); ++v) {
    const LogicalVolume& volume = world.volumes[v];
    const bool by_material = with_materials && volume.material < world.materials.size() &&
                             matches(pattern, world.materials[volume.material].name);
    if (!by_material && !matches(pattern, volume.name)) continue;
    flags[v] = value;
    found = true;
  }
  return found;
}

void mark_below(const World& world, VolumeId volume, std::vector<bool>& flags) {
  std::vector<VolumeId> todo{volume};
  std::vector<bool> seen(world.volumes.size());
  while (!todo.empty()) {
    const VolumeId next = todo.back();
    todo.pop_back();
    if (seen[next]) continue;
    seen[next] = true;
    flags[next] = true;
    for (const Placement& daughter : world.volumes[next].daughters) todo.push_back(daughter.volume);
  }
}

[[noreturn]] void no_such(const std::string& what, const std::string& name) {
  throw Error("no " + what + " is called '" + name + "'; navjit inspect lists them");
}

/// An axis, and the two across it.
double& coordinate(Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/// Widens `seen` by what rays along one axis, through the box, meet first.
void probe(Navigator& navigator, const World& world, const Visible& visible,
           const std::vector<Cut>& cuts, const Extent& box, int axis, double sign, Extent& seen) {
  constexpr int rays = 80;
  const int across = (axis + 1) % 3, up = (axis + 2) % 3;
  Extent limits = box, all = world.volumes[world.top].solid.extent;
  Vec3 cell = (1.0 / rays) * (box.max - box.min);
  for (int i = 0; i < rays * rays; ++i) {
    Ray ray{box.min, {0, 0, 0}};
    coordinate(ray.direction, axis) = sign;
    coordinate(ray.position, across) += (i % rays + 0.5) * coordinate(cell, across);
    coordinate(ray.position, up) += (i / rays + 0.5) * coordinate(cell, up);
    const double low = coordinate(all.min, axis), high = coordinate(all.max, axis);
    coordinate(ray.position, axis) =
        sign > 0 ? low - 0.01 * (high - low) : high + 0.01 * (high - low);
    const std::vector<Gap> gaps = gaps_of(cuts, ray);
    pass_uncut(navigator, world, ray, gaps, [&](const common::Leg& leg, const Vec3*) {
      if (!visible.opaque[leg.state.volume()] || !(leg.from < leg.to)) return true;
      Vec3 p = ray.position + leg.from * ray.direction;
      for (int k = 0; k < 3; ++k) {
        const double around = k == axis ? 0 : coordinate(cell, k) / 2;
        const double c = coordinate(p, k);
        coordinate(seen.min, k) =
            std::min(coordinate(seen.min, k), std::max(c - around, coordinate(limits.min, k)));
        coordinate(seen.max, k) =
            std::max(coordinate(seen.max, k), std::min(c + around, coordinate(limits.max, k)));
      }
      return false;
    });
  }
}

/// Around all that is opaque in the world, mm: as far as boxes tell. Null if nothing is.
std::optional<Extent> opaque_box(const World& world, const Visible& visible) {
  std::vector<std::optional<Extent>> boxes(world.volumes.size());
  std::vector<bool> known(world.volumes.size());
  const auto widen = [](std::optional<Extent>& box, const Vec3& p) {
    if (!box) box = Extent{p, p};
    box->min = {std::min(box->min.x, p.x), std::min(box->min.y, p.y), std::min(box->min.z, p.z)};
    box->max = {std::max(box->max.x, p.x), std::max(box->max.y, p.y), std::max(box->max.z, p.z)};
  };
  const std::function<void(VolumeId)> look = [&](VolumeId v) {
    known[v] = true;
    const LogicalVolume& volume = world.volumes[v];
    std::optional<Extent> box;
    for (const Placement& daughter : volume.daughters) {
      if (!known[daughter.volume]) look(daughter.volume);
      const std::optional<Extent>& inner = boxes[daughter.volume];
      for (int corner = 0; inner && corner < 8; ++corner) {
        widen(box, to_outer(daughter.transformation, corner_of(*inner, corner)));
      }
    }
    // Daughters that stick out of it are not seen there.
    if (box) {
      const Extent& own = volume.solid.extent;
      box->min = {std::max(box->min.x, own.min.x), std::max(box->min.y, own.min.y),
                  std::max(box->min.z, own.min.z)};
      box->max = {std::min(box->max.x, own.max.x), std::min(box->max.y, own.max.y),
                  std::min(box->max.z, own.max.z)};
    }
    if (visible.opaque[v]) box = volume.solid.extent;
    boxes[v] = box;
  };
  look(world.top);
  return boxes[world.top];
}

}  // namespace

bool is_transparent(const Material& material) {
  return material.state == MaterialState::gas || material.density < densest_gas;
}

Visible visible_of(const World& world, const ShowOptions& options) {
  const std::size_t volumes = world.volumes.size();
  Visible visible{std::vector<bool>(volumes, true), std::vector<bool>(volumes, true)};
  for (std::size_t v = 0; v < volumes; ++v) {
    const LogicalVolume& volume = world.volumes[v];
    visible.opaque[v] = v != world.top && volume.material < world.materials.size() &&
                        !is_transparent(world.materials[volume.material]);
  }
  if (!options.only.empty()) {
    std::vector<bool> named(volumes), kept(volumes);
    for (const std::string& name : options.only) {
      if (!mark(world, name, true, false, named)) no_such("volume", name);
    }
    for (VolumeId v = 0; v < volumes; ++v) {
      if (named[v]) mark_below(world, v, kept);
    }
    for (std::size_t v = 0; v < volumes; ++v) {
      visible.counted[v] = kept[v];
      visible.opaque[v] = visible.opaque[v] && kept[v];
    }
  }
  for (const std::string& name : options.show) {
    if (!mark(world, name, true, true, visible.opaque)) no_such("volume or material", name);
    mark(world, name, true, true, visible.counted);
  }
  for (const std::string& name : options.hide) {
    if (!mark(world, name, false, true, visible.opaque)) no_such("volume or material", name);
    mark(world, name, false, true, visible.counted);
  }
  return visible;
}

Extent seen_box(Runtime& runtime, const Visible& visible, const std::vector<Cut>& cuts) {
  const World& world = runtime.world();
  Navigator navigator = runtime.navigator();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto volume_of = [](const Extent& box) {
    const Vec3 size = box.max - box.min;
    return size.x * size.y * size.z;
  };
  Extent box = opaque_box(world, visible).value_or(world.volumes[world.top].solid.extent);
  // Boxes of turned volumes are too large, and cuts take much away: a few looks make it smaller.
  for (int look = 0; look < 6; ++look) {
    Extent seen{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {1.0, -1.0}) {
        probe(navigator, world, visible, cuts, box, axis, sign, seen);
      }
    }
    if (!(seen.min.x < infinity)) break;
    const bool settled = volume_of(seen) > 0.7 * volume_of(box);
    box = seen;
    if (settled) break;
  }
  return box;
}

}  // namespace navjit::picture
