// Facts about the volumes of a world that follow from the tree alone.
#pragma once

#include <map>
#include <set>
#include <vector>

#include "analysis/known_plans.hpp"
#include "analysis/scene_plan.hpp"

namespace navjit {

/// Of volumes that share code (equal_scenes): what it may assume.
struct EqualFacts {
  FrameFacts frame;                     ///< of all touchables of all of them
  std::optional<VolumeId> only_mother;  ///< all placements of all of them are in this volume
  std::optional<VolumeId> mothers;      ///< or in volumes that share code: the first of these
  /// The daughters of one of them are not those of another, or some daughters of one are different
  /// volumes that share code: for code they are all the first of their equals.
  bool stand_ins = false;
};

struct WorldFacts {
  std::vector<FrameFacts> frames;                     ///< by volume
  std::vector<std::optional<VolumeId>> only_mothers;  ///< by volume
  std::vector<TouchableId> touchables;  ///< by volume: how often it occurs in the tree
  std::vector<char> reachable;          ///< by volume: occurs in the tree at all
  /// By volume: the first volume of those that share code, and by that one all of them, and what
  /// they have in common (equal_scenes).
  std::vector<VolumeId> first_equal;
  std::vector<std::vector<VolumeId>> equals;
  std::vector<EqualFacts> of_equals;
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
