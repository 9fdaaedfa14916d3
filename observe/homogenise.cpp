#include "observe/homogenise.hpp"

#include <algorithm>
#include <cmath>

#include "navjit/errors.hpp"
#include "observe/budget.hpp"

namespace navjit {
namespace {

constexpr std::uint64_t rays_to_choose = 4000, rays_to_judge = 20000;
/// The mean change, with this many times its standard error, has to be within the budget.
constexpr double standard_deviations = 3;
constexpr int attempts = 12;

ObservationReport::Measured measured(const RayChanges& c, std::uint64_t rays) {
  return {.rays = rays,
          .whole = c.whole,
          .mean = c.mean,
          .mean_error = c.error,
          .signed_mean = c.signed_mean,
          .signed_error = c.signed_error,
          .of_99_percent = c.of_99,
          .of_999_permille = c.of_999,
          .largest = c.largest};
}

/// The tags of a volume except thresholds, which follow from its old material.
Auxiliaries without_thresholds(const Auxiliaries& tags) {
  if (!tags) return tags;
  std::vector<Auxiliary> left;
  for (const Auxiliary& tag : *tags) {
    if (!is_threshold(tag)) left.push_back(tag);
  }
  if (left.size() == tags->size()) return tags;
  return left.empty() ? nullptr : std::make_shared<const std::vector<Auxiliary>>(std::move(left));
}

/// The most by which a mixture differs from the materials that it replaces, for each mm.
double largest_difference(const World& world, const std::vector<double>& rates, VolumeId mother,
                          const std::set<VolumeId>& daughters, double rate) {
  double largest = std::abs(rates[world.volumes[mother].material] - rate);
  std::vector<VolumeId> open(daughters.begin(), daughters.end());
  std::set<VolumeId> seen(daughters);
  while (!open.empty()) {
    const VolumeId v = open.back();
    open.pop_back();
    largest = std::max(largest, std::abs(rates[world.volumes[v].material] - rate));
    for (const Placement& p : world.volumes[v].daughters) {
      if (seen.insert(p.volume).second) open.push_back(p.volume);
    }
  }
  return largest;
}

/// A name that no material has.
std::string unused_name(const World& world, const std::string& wanted) {
  std::set<std::string> names;
  for (const Material& m : world.materials) names.insert(m.name);
  std::string name = wanted;
  for (int i = 2; names.contains(name); ++i) name = wanted + '_' + std::to_string(i);
  return name;
}

void put_in(Homogenised& made, const Mixtures& mixtures, const std::vector<double>& rates,
            const World& original) {
  World& world = made.world;
  const std::vector<double> counts = touchables_of(original);
  const double path = longest_path(original);
  for (const auto& [mother, daughters] : made.chosen) {
    Material material = mixtures.material(mother, daughters);
    material.name = unused_name(world, material.name);
    LogicalVolume& volume = world.volumes[mother];
    ObservationReport::Mixture entry{.volume = volume.name,
                                     .material = material.name,
                                     .number = static_cast<std::uint32_t>(world.materials.size()),
                                     .density = material.density,
                                     .radiation_length = material.radiation_length};
    double whole = 0;
    const auto parts = mixtures.parts(mother, daughters);
    for (const auto& [number, part] : parts) whole += part;
    for (const auto& [number, part] : parts) entry.parts.push_back({number, part / whole});
    for (const VolumeId d : daughters) entry.of.push_back(world.volumes[d].name);
    for (const Placement& p : volume.daughters) entry.placements += daughters.contains(p.volume);
    const double most =
        largest_difference(original, rates, mother, daughters, mixtures.rate(mother, daughters));
    entry.bound = most * std::min(counts[mother] * longest_chord(volume.solid), path);
    made.bound += entry.bound;
    made.mixtures.push_back(std::move(entry));
    volume.material = static_cast<std::uint32_t>(world.materials.size());
    volume.auxiliaries = without_thresholds(volume.auxiliaries);
    world.materials.push_back(std::move(material));
  }
}

}  // namespace

Homogenised homogenise(const std::shared_ptr<const World>& world, const Observation& observation) {
  const Marks marks = find_marks(*world, observation);
  const std::vector<double> rates = material_rates(*world, observation.unit);
  const Mixtures mixtures(*world, marks, rates);
  Homogenised made{*world, {}, {}, {}, 0};
  const Passages to_choose =
      pass_through(world, sample(*world, observation.rays, rays_to_choose, 1));
  if (to_choose.lengths.empty()) {
    throw GeometryError("no ray that mixtures are measured with meets the detector");
  }
  double share = 1;
  for (int attempt = 0; attempt <= attempts; ++attempt) {
    const auto rays =
        sample(*world, observation.rays, rays_to_judge, 2 + static_cast<std::uint64_t>(attempt));
    const Passages to_judge = pass_through(world, rays);
    // The last attempt mixes nothing.
    made.chosen.clear();
    RayChanges changes = changes_of(*world, mixtures, rates, to_judge, made.chosen);
    const double most = observation.unit == Observation::Unit::relative
                            ? observation.budget * changes.whole
                            : observation.budget;
    if (attempt < attempts) {
      made.chosen = choose_mixtures(*world, mixtures, rates, to_choose, share * most);
      changes = changes_of(*world, mixtures, rates, to_judge, made.chosen);
    }
    made.measured = measured(changes, rays_to_judge);
    const double sure = changes.mean + standard_deviations * changes.error;
    if (sure <= most) break;
    share *= std::min(0.95, most / sure);
  }
  put_in(made, mixtures, rates, *world);
  finish(made.world);
  return made;
}

}  // namespace navjit
