#include "observe/mixtures.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/bvh/box_tree_traversal.hpp"
#include "geometry/model/order.hpp"
#include "geometry/model/placed_extent.hpp"
#include "geometry/solids/extent.hpp"
#include "observe/separation.hpp"

namespace navjit {
namespace {

/// Whether all daughters are within the volume and apart from one another, so that their volumes
/// can be added.
bool adds_up(const World& world, const LogicalVolume& volume, Separation& separation,
             double tolerance) {
  std::vector<Extent> boxes;
  for (const Placement& p : volume.daughters) {
    const Solid& solid = world.volumes[p.volume].solid;
    if (separation.within({solid, p.transformation}, volume.solid) == Certainty::no) return false;
    boxes.push_back(placed_extent(solid, p.transformation));
  }
  if (boxes.empty()) return true;
  const bvh::BoxTree tree(boxes, tolerance, bvh::default_method(boxes.size()));
  bool apart = true;
  for (std::uint32_t a = 0; a < boxes.size() && apart; ++a) {
    tree.overlapping(boxes[a], [&](std::uint32_t b) {
      if (b <= a || !share_more_than(tolerance, boxes[a], boxes[b])) return true;
      const Placement &p = volume.daughters[a], &q = volume.daughters[b];
      apart = separation.apart({world.volumes[p.volume].solid, p.transformation},
                               {world.volumes[q.volume].solid, q.transformation}) != Certainty::no;
      return apart;
    });
  }
  return apart;
}

}  // namespace

Mixtures::Mixtures(const World& world, const Marks& marks, const std::vector<double>& rates)
    : world_(world),
      marks_(marks),
      rates_(rates),
      own_volume_(world.volumes.size(), -1),
      counts_(world.volumes.size()),
      whole_(world.volumes.size()),
      possible_(world.volumes.size()),
      why_(world.volumes.size()) {
  for (VolumeId v = 0; v < world.volumes.size(); ++v) {
    for (const Placement& p : world.volumes[v].daughters) ++counts_[v][p.volume];
  }
  const double tolerance = std::max(least_overlap, 8 * world.tolerance);
  Separation separation(tolerance, world.tolerance);
  // Whether all that is in a volume may be mixed with what is around the volume, apart from tags.
  std::vector<bool> dissolves(world.volumes.size());
  for (const VolumeId v : daughters_first(world)) {
    const LogicalVolume& volume = world.volumes[v];
    if (volume.material >= rates.size() || rates[volume.material] < 0 ||
        world.materials[volume.material].elements.empty()) {
      why_[v] = "its material is not known";
      continue;
    }
    double own = capacity(volume.solid);
    const double whole = own;
    bool known = own > 0;
    for (const Placement& p : volume.daughters) {
      const double inner = capacity(world.volumes[p.volume].solid);
      known = known && inner >= 0;
      own -= inner;
    }
    // Rounding may give a little less than nothing if daughters fill the volume.
    if (!known || !(own > -1e-9 * whole)) {
      why_[v] = "its volume, or that of a daughter, is not known in closed form";
      continue;
    }
    if (!adds_up(world, volume, separation, tolerance)) {
      why_[v] = "daughters overlap, or reach out of it, or might";
      continue;
    }
    own_volume_[v] = std::max(own, 0.0);
    dissolves[v] = true;
    for (const Placement& p : volume.daughters) {
      const VolumeId d = p.volume;
      if (dissolves[d] && may_disappear(d, v)) {
        possible_[v].insert(d);
      } else {
        dissolves[v] = false;
      }
    }
    // Only volumes that are within others as a whole need their parts.
    if (dissolves[v]) whole_[v] = parts(v, possible_[v]);
    if (!volume.daughters.empty() && possible_[v].empty()) {
      why_[v] = "what is in it is observed, of another region or other tags, or cannot be mixed";
    }
  }
}

bool Mixtures::may_disappear(VolumeId volume, VolumeId mother) const {
  return marks_.settings[volume] == marks_.settings[mother] && !marks_.observed[volume] &&
         !marks_.heads[volume];
}

Mixtures::Parts Mixtures::parts(VolumeId mother, const std::set<VolumeId>& daughters) const {
  Parts parts{{world_.volumes[mother].material, own_volume_[mother]}};
  for (const VolumeId daughter : daughters) {
    const auto count = counts_[mother].find(daughter);
    if (count == counts_[mother].end()) continue;
    for (const auto& [material, part] : whole_[daughter]) parts[material] += count->second * part;
  }
  return parts;
}

double Mixtures::rate(VolumeId mother, const std::set<VolumeId>& daughters) const {
  double volume = 0, integral = 0;
  for (const auto& [material, part] : parts(mother, daughters)) {
    volume += part;
    integral += part * rates_[material];
  }
  return integral / volume;
}

Material Mixtures::material(VolumeId mother, const std::set<VolumeId>& daughters) const {
  double volume = 0, mass = 0, most = 0;
  std::map<std::uint32_t, double> elements;  // mass of each
  Material mixture;
  for (const auto& [number, part] : parts(mother, daughters)) {
    const Material& m = world_.materials[number];
    volume += part;
    mass += part * m.density;
    for (const ElementShare& share : m.elements) {
      elements[share.element] += part * m.density * share.fraction;
    }
    // State, temperature and pressure are those of the part with the largest mass.
    if (part * m.density > most) {
      most = part * m.density;
      mixture.state = m.state;
      mixture.temperature = m.temperature;
      mixture.pressure = m.pressure;
    }
  }
  mixture.name = world_.volumes[mother].name + "_mixture";
  if (mass > 0) {
    mixture.density = mass / volume;
    for (const auto& [element, part] : elements) {
      if (part > 0) mixture.elements.push_back({element, part / mass});
    }
  } else {  // vacuum in vacuum
    mixture = world_.materials[world_.volumes[mother].material];
    mixture.name = world_.volumes[mother].name + "_mixture";
  }
  const double per_area = radiation_length(world_, mixture.elements);
  if (per_area > 0 && mixture.density > 0) {
    mixture.radiation_length = per_area / mixture.density * 10;
  }
  return mixture;
}

}  // namespace navjit
