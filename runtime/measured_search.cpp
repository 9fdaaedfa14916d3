#include "runtime/measured_search.hpp"

#include <map>
#include <set>

#include "analysis/plan.hpp"

namespace navjit {
namespace {

/// Whether the plan of the analysis gives code that spells out every daughter. Constants are folded
/// in such code, so timings with numbers as data say nothing about it. In a mother of three shells
/// another search won by some ticks when bound to data, but as code took 60 ns instead of 28.
bool is_spelled_out(const ScenePlan& plan) {
  return plan.candidates == Candidates::all || plan.candidates == Candidates::lanes;
}

}  // namespace

ScenePlan plan_without_measurement(Specialisation& spec, VolumeId volume) {
  const VolumeId first = spec.facts.first_equal[volume];
  if (spec.forced.contains(first)) return plan_scene(spec.shared->geometry, spec.facts, volume);
  auto measured = spec.facts.forced_candidates.extract(first);
  ScenePlan plan = plan_scene(spec.shared->geometry, spec.facts, volume);
  if (measured) spec.facts.forced_candidates.insert(std::move(measured));
  return plan;
}

void search_as_bound(Specialisation& spec, VolumeId volume) {
  const VolumeId first = spec.facts.first_equal[volume];
  if (spec.forced.contains(first)) return;
  spec.facts.forced_candidates.erase(first);
  const auto bound = spec.without_code.find(volume);
  if (bound == spec.without_code.end()) return;
  const auto search = spec.searches.find(bound->second);
  if (search == spec.searches.end() || !may_be_listed(search->second)) return;
  if (is_spelled_out(plan_without_measurement(spec, volume))) return;
  spec.facts.forced_candidates[first] = search->second;
}

void search_as_listed(Specialisation& spec, const ListedScene& scene) {
  const VolumeId first = spec.facts.first_equal[scene.volume];
  if (scene.search && !spec.forced.contains(first)) {
    spec.facts.forced_candidates[first] = *scene.search;
  }
}

ListedModule to_be_listed(const Specialisation& spec, const std::vector<VolumeId>& scenes) {
  const std::map<VolumeId, Candidates>& measured = spec.facts.forced_candidates;
  ListedModule module;
  std::set<VolumeId> firsts;
  for (const VolumeId volume : scenes) {
    const VolumeId first = spec.facts.first_equal[volume];
    firsts.insert(first);
    const auto found = measured.find(first);
    const bool none = found == measured.end() || spec.forced.contains(first);
    module.scenes.push_back(none ? ListedScene{volume} : ListedScene{volume, found->second});
  }
  for (const auto& [first, search] : measured) {
    if (firsts.contains(first) || spec.forced.contains(first)) continue;
    module.beside.push_back({first, search});
  }
  return module;
}

}  // namespace navjit
