// Facts about the volumes of a world that follow from the tree alone.
#pragma once

#include <map>
#include <set>
#include <vector>

#include "analysis/known_plans.hpp"
#include "analysis/scene_plan.hpp"

namespace navjit {

/// What code may assume of the volumes that share it (equal_scenes).
struct EqualFacts {
  FrameFacts frame;                     ///< of all touchables of all these volumes
  std::optional<VolumeId> only_mother;  ///< the volume in which all their placements are
  std::optional<VolumeId> mothers;  ///< if they are in volumes that share code: the first of these
  /// The daughters differ between these volumes, or some daughters of one are different volumes
  /// that share code. Code then knows each daughter by the first of its equals.
  bool stand_ins = false;
};

struct WorldFacts {
  std::vector<FrameFacts> frames;                     ///< by volume
  std::vector<std::optional<VolumeId>> only_mothers;  ///< by volume
  std::vector<TouchableId> touchables;  ///< by volume: how often it occurs in the tree
  std::vector<char> reachable;          ///< by volume: occurs in the tree at all
  /// By volume: the first of the volumes that share code. By that volume: all of them, and what
  /// they have in common (equal_scenes).
  std::vector<VolumeId> first_equal;
  std::vector<std::vector<VolumeId>> equals;
  std::vector<EqualFacts> of_equals;
  /// The search of volumes for which the analysis does not choose it.
  std::map<VolumeId, Candidates> forced_candidates;
  bool with_safety = true;  ///< plan a safety for each scene
  /// Volumes (each the first of its equals) whose navigators have to make steps along faces and
  /// from within daughters.
  std::set<VolumeId> along_faces;
  /// The plans of this world, which copies of these facts share.
  std::shared_ptr<KnownPlans> known_plans = std::make_shared<KnownPlans>();
};

WorldFacts analyse_world(const Geometry& geometry);

}  // namespace navjit
