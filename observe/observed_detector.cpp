#include <cmath>

#include "geometry/detector/touchables.hpp"
#include "geometry/model/transformation.hpp"
#include "navjit/errors.hpp"
#include "navjit/observation.hpp"
#include "observe/dissolve.hpp"

namespace navjit {

struct ObservedDetector::Data {
  Observation observation;
  Detector original, simplified;
  std::vector<std::uint32_t> classes;
  std::vector<std::vector<TouchableId>> offsets;  ///< as in Dissolved
  std::vector<std::vector<bool>> gone;
  ObservationReport report;
};

ObservedDetector::ObservedDetector(const Detector& original, const Observation& observation) {
  const World& world = *original.model();
  MaterialGroups groups;
  if (observation.kind == Observation::Kind::budget) {
    if (!(observation.budget > 0)) {
      throw GeometryError("a budget of radiation lengths has to be positive");
    }
    // Materials that are nearly the same may take half of it, small volumes what is left.
    groups = group_materials(world, observation.budget / 2);
  }
  const Marks marks = find_marks(world, observation, groups.group_of);
  auto data = std::make_shared<Data>(Data{observation, original, original, {}, {}, {}, {}});
  if (observation.kind == Observation::Kind::all) {
    data->report.placements_before = 0;
    for (const LogicalVolume& volume : world.volumes) {
      if (volume.touchables > 0) data->report.placements_before += volume.daughters.size();
    }
    data->report.placements_after = data->report.placements_before;
    data->report.touchables_before = data->report.touchables_after = original.touchables();
  } else {
    SmallVolumes small;
    if (observation.kind == Observation::Kind::budget) {
      small = choose_small(world, marks, observation.budget - groups.bound);
    }
    Dissolved dissolved = dissolve(world, marks, small);
    dissolved.report.bound += groups.bound;
    data->simplified = Detector(std::move(dissolved.world));
    data->offsets = std::move(dissolved.offsets);
    data->gone = std::move(dissolved.gone);
    data->report = std::move(dissolved.report);
    data->classes = marks.classes;
    for (std::size_t v = 0; v < data->classes.size(); ++v) {
      if (marks.observed[v] || marks.ambiguous[v]) data->classes[v] |= always;
    }
  }
  data_ = std::move(data);
  classes_ = data_->classes.data();
  classes_size_ = data_->classes.size();
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
  for (bool deeper = true; deeper;) {
    deeper = false;
    const auto& daughters = world.volumes[at.volume()].daughters;
    // Where daughters overlap the last counts, as in navigation.
    for (std::size_t k = daughters.size(); k-- > 0 && !deeper;) {
      if (!data_->gone[at.volume()][k]) continue;
      const Placement& daughter = daughters[k];
      const Vec3 q = to_local(daughter.transformation, p);
      const Vec3 w = direction_to_local(daughter.transformation, v);
      if (!contains(world.volumes[daughter.volume].solid.any(), q,
                    kernels::make_heading(w.x, w.y, w.z), world.tolerance)) {
        continue;
      }
      p = q;
      v = w;
      at = {at.touchable() + daughter.offset, daughter.volume};
      deeper = true;
    }
  }
  return at;
}

}  // namespace navjit
