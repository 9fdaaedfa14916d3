#include <cmath>

#include "geometry/detector/touchables.hpp"
#include "geometry/model/transformation.hpp"
#include "navjit/errors.hpp"
#include "navjit/observation.hpp"
#include "observe/dissolve.hpp"
#include "observe/homogenise.hpp"

namespace navjit {

struct ObservedDetector::Data {
  static constexpr std::uint32_t always = ObservedDetector::always;

  Observation observation;
  Detector original, simplified;
  std::vector<std::uint32_t> classes;
  std::vector<std::vector<TouchableId>> offsets;  ///< as in Dissolved
  std::vector<std::vector<bool>> gone;
  ChosenMixtures mixed;
  ObservationReport report;

  bool is_mixed(VolumeId mother, VolumeId daughter) const {
    const auto found = mixed.find(mother);
    return found != mixed.end() && found->second.contains(daughter);
  }
};

namespace {

/// The number of rays that tell which volumes are passed, and how. It is small, since only speed
/// depends on them.
constexpr std::uint64_t rays_to_count = 500;

void see_all(ObservedDetector::Data& data) {
  ObservationReport& report = data.report;
  for (const LogicalVolume& volume : data.original.model()->volumes) {
    if (volume.touchables > 0) report.placements_before += volume.daughters.size();
  }
  report.placements_after = report.placements_before;
  report.touchables_before = report.touchables_after = data.original.touchables();
}

/// `world` has the tree of the original and also its materials, except for mixtures.
void simplify(ObservedDetector::Data& data, const World& world, double budget,
              const ChosenMixtures& mixed) {
  MaterialGroups groups;
  const bool merges = data.observation.kind == Observation::Kind::budget;
  // Materials that are nearly the same may use half of the budget, and small volumes the rest.
  const Observation::Unit unit = data.observation.unit;
  if (merges) {
    const bool all_of_it = unit == Observation::Unit::relative;
    groups = group_materials(world, all_of_it ? budget : budget / 2, unit);
  }
  const Marks marks = find_marks(world, data.observation, groups.group_of);
  SmallVolumes small;
  if (merges) small = choose_small(world, marks, budget - groups.bound, unit);
  DissolveOptions options;
  if (mixed.empty() && anything_unseen(world, marks, small)) {
    const Passages passages =
        pass_through(data.original.model(), sample(world, data.observation.rays, rays_to_count, 1));
    options.kept = better_kept(world, marks, small, passages, options.most_daughters);
  }
  Dissolved dissolved = dissolve(world, marks, small, mixed, options);
  dissolved.report.bound += groups.bound;
  data.simplified = Detector(std::move(dissolved.world));
  data.offsets = std::move(dissolved.offsets);
  data.gone = std::move(dissolved.gone);
  data.report = std::move(dissolved.report);
  data.classes = marks.classes;
  for (std::size_t v = 0; v < data.classes.size(); ++v) {
    if (marks.observed[v] || marks.ambiguous[v]) {
      data.classes[v] |= ObservedDetector::Data::always;
    }
  }
}

}  // namespace

ObservedDetector::ObservedDetector(const Detector& original, const Observation& observation) {
  if (observation.kind == Observation::Kind::budget ||
      observation.kind == Observation::Kind::mixtures) {
    if (!(observation.budget > 0)) throw GeometryError("a budget has to be positive");
  }
  auto data = std::make_shared<Data>(Data{observation, original, original, {}, {}, {}, {}, {}});
  switch (observation.kind) {
    case Observation::Kind::all:
      see_all(*data);
      break;
    case Observation::Kind::mixtures: {
      Homogenised made = homogenise(original.model(), observation);
      simplify(*data, made.world, 0, made.chosen);
      data->mixed = std::move(made.chosen);
      data->report.bound += made.bound;
      data->report.mixtures = std::move(made.mixtures);
      data->report.measured = made.measured;
      break;
    }
    case Observation::Kind::materials:
    case Observation::Kind::budget:
      simplify(*data, *original.model(), observation.budget, {});
      break;
  }
  data_ = std::move(data);
  classes_ = data_->classes.data();
  classes_size_ = data_->classes.size();
  tolerance_ = data_->simplified.tolerance();
}

const Detector& ObservedDetector::detector() const { return data_->simplified; }
const Detector& ObservedDetector::original() const { return data_->original; }
const Observation& ObservedDetector::observation() const { return data_->observation; }
const ObservationReport& ObservedDetector::report() const { return data_->report; }

State ObservedDetector::original(const State& state) const {
  if (!state.inside()) return {};
  if (data_->offsets.empty()) {
    check_state(*data_->original.model(), state);
    return state;
  }
  const TouchableLevels levels = levels_of(*data_->simplified.model(), state);
  TouchableId touchable = 0;
  for (std::size_t i = 1; i < levels.size(); ++i) {
    touchable += data_->offsets[levels[i - 1].volume][levels[i].daughter];
  }
  return {touchable, state.volume()};
}

State ObservedDetector::original(const State& state, const Vec3& point,
                                 const Vec3& direction) const {
  State at = original(state);
  if (!at.inside() || data_->gone.empty()) return at;
  if (!std::isfinite(norm(point)) || !std::isfinite(norm(direction))) {
    throw UsageError("the point or the direction is not finite");
  }
  const World& world = *data_->original.model();
  const Transformation frame = data_->original.frame(at);
  Vec3 p = to_local(frame, point), v = direction_to_local(frame, direction);
  bool in_mixture = false;  // then all below was mixed, whatever is left of it elsewhere
  for (bool deeper = true; deeper;) {
    deeper = false;
    const auto& daughters = world.volumes[at.volume()].daughters;
    // If daughters overlap the last one counts, as in navigation.
    for (std::size_t k = daughters.size(); k-- > 0 && !deeper;) {
      if (!in_mixture && !data_->gone[at.volume()][k]) continue;
      const Placement& daughter = daughters[k];
      const Vec3 q = to_local(daughter.transformation, p);
      const Vec3 w = direction_to_local(daughter.transformation, v);
      if (!contains(world.volumes[daughter.volume].solid.any(), q,
                    kernels::make_heading(w.x, w.y, w.z), world.tolerance)) {
        continue;
      }
      p = q;
      v = w;
      in_mixture = in_mixture || data_->is_mixed(at.volume(), daughter.volume);
      at = {at.touchable() + daughter.offset, daughter.volume};
      deeper = true;
    }
  }
  return at;
}

}  // namespace navjit
