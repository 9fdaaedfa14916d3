// Facts about the volumes of a world that follow from the tree alone.
#pragma once

#include <map>
#include <set>
#include <vector>

#include "analysis/known_plans.hpp"
#include "analysis/scene_plan.hpp"

namespace navjit {

struct WorldFacts {
  std::vector<FrameFacts> frames;                     ///< by volume
  std::vector<std::optional<VolumeId>> only_mothers;  ///< by volume
  std::vector<TouchableId> touchables;  ///< by volume: how often it occurs in the tree
  std::vector<char> reachable;          ///< by volume: occurs in the tree at all
  /// By volume: the first volume of equal structure, and by that one all of them (equal_scenes).
  std::vector<VolumeId> first_equal;
  std::vector<std::vector<VolumeId>> equals;
  /// Volumes whose candidates are not to be chosen by the analysis, but to be these.
  std::map<VolumeId, Candidates> forced_candidates;
  bool with_safety = true;  ///< plan a safety for each scene
  /// Volumes (each the first of its equals) whose navigators have to take steps along faces or from
  /// within daughters.
  std::set<VolumeId> along_faces;
  /// Of this world; copies of the facts share them.
  std::shared_ptr<KnownPlans> known_plans = std::make_shared<KnownPlans>();
};

WorldFacts analyse_world(const Geometry& geometry);

}  // namespace navjit
