#include "observe/budget.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/model/order.hpp"
#include "navjit/vector.hpp"

namespace navjit {
namespace {

double surface(const Extent& e) {
  const Vec3 d = e.max - e.min;
  return 2 * (d.x * d.y + d.y * d.z + d.z * d.x);
}

struct Candidate {
  std::pair<VolumeId, VolumeId> pair;
  double change, gain;
};

}  // namespace

double longest_path(const World& world) {
  const Extent& e = world.volumes[world.top].solid.extent;
  return norm(e.max - e.min);
}

double longest_chord(const Solid& solid) {
  if (solid.kind == SolidKind::orb) return solid.extent.max.x - solid.extent.min.x;
  if (solid.kind == SolidKind::tube) {
    const auto& tube = *static_cast<const kernels::Tube<double>*>(solid.shape.get());
    return 2 * std::hypot(tube.rmax, tube.hz);
  }
  return norm(solid.extent.max - solid.extent.min);
}

std::vector<double> touchables_of(const World& world) {
  std::vector<double> counts(world.volumes.size());
  counts[world.top] = 1;
  std::vector<VolumeId> order = daughters_first(world);
  for (auto v = order.rbegin(); v != order.rend(); ++v) {
    for (const Placement& p : world.volumes[*v].daughters) counts[p.volume] += counts[*v];
  }
  return counts;
}

std::vector<double> material_rates(const World& world, Observation::Unit unit) {
  std::vector<double> rates;
  for (const Material& m : world.materials) {
    // If a material has no elements, the file may say nothing about it.
    const double nothing = m.density == 0 && !m.elements.empty() ? 0 : -1;
    if (unit == Observation::Unit::grams_per_cm2) {
      rates.push_back(m.density > 0 ? m.density / 10 : nothing);
    } else {
      rates.push_back(m.radiation_length > 0 ? 1 / m.radiation_length : nothing);
    }
  }
  return rates;
}

MaterialGroups group_materials(const World& world, double budget, Observation::Unit unit) {
  const std::vector<double> rates = material_rates(world, unit);
  const bool relative = unit == Observation::Unit::relative;
  const double path = longest_path(world);
  MaterialGroups groups;
  groups.group_of.resize(world.materials.size());
  std::vector<std::uint32_t> order;
  std::uint32_t next = 0;
  std::vector<bool> used(world.materials.size());
  for (const LogicalVolume& volume : world.volumes) {
    if (volume.touchables > 0 && volume.material < used.size()) used[volume.material] = true;
  }
  for (std::uint32_t m = 0; m < world.materials.size(); ++m) {
    if (used[m] && rates[m] >= 0) {
      order.push_back(m);
    } else {
      groups.group_of[m] = next++;
    }
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return rates[a] < rates[b]; });
  double first = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double own = rates[order[i]];
    if (i == 0 || own - first > (relative ? budget * first : budget / path)) {
      first = own;
      ++next;
    }
    if (own > first) {
      groups.bound = std::max(groups.bound, relative ? own / first - 1 : (own - first) * path);
    }
    groups.group_of[order[i]] = next - 1;
  }
  return groups;
}

SmallVolumes choose_small(const World& world, const Marks& marks, double budget,
                          Observation::Unit unit) {
  if (unit == Observation::Unit::relative) return {};
  const std::vector<double> rates = material_rates(world, unit);
  const auto rate_of = [&](VolumeId v) {
    const std::uint32_t material = world.volumes[v].material;
    return material < rates.size() ? rates[material] : -1;
  };
  const double path = longest_path(world);
  const std::vector<double> counts = touchables_of(world);
  std::map<std::pair<VolumeId, VolumeId>, double> placed;
  for (VolumeId m = 0; m < world.volumes.size(); ++m) {
    if (world.volumes[m].touchables == 0) continue;
    for (const Placement& p : world.volumes[m].daughters) placed[{p.volume, m}] += counts[m];
  }
  std::vector<Candidate> candidates;
  for (const auto& [pair, count] : placed) {
    const auto [d, m] = pair;
    const double inner = rate_of(d), outer = rate_of(m);
    if (inner < 0 || outer < 0 || invisible(marks, d, m) || !of_one_kind(marks, d, m)) continue;
    // A daughter of the volume's own material is invisible in it, and would become visible.
    const auto& below = world.volumes[d].daughters;
    if (std::any_of(below.begin(), below.end(), [&, inside = d](const Placement& p) {
          return marks.own[p.volume] == marks.own[inside];
        })) {
      continue;
    }
    const Solid& solid = world.volumes[d].solid;
    const double change = std::abs(inner - outer) * std::min(count * longest_chord(solid), path);
    if (change <= budget) candidates.push_back({pair, change, count * surface(solid.extent)});
  }
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [](const Candidate& a, const Candidate& b) { return a.gain * b.change > b.gain * a.change; });
  SmallVolumes chosen;
  for (const Candidate& c : candidates) {
    if (c.change > budget) continue;
    budget -= c.change;
    chosen.emplace(c.pair, c.change);
  }
  return chosen;
}

}  // namespace navjit
