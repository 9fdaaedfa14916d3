#include "observe/dissolve.hpp"

#include <algorithm>
#include <map>

#include "geometry/bvh/box_tree_traversal.hpp"
#include "geometry/model/order.hpp"
#include "geometry/model/placed_extent.hpp"
#include "navjit/errors.hpp"
#include "observe/separation.hpp"

namespace navjit {
namespace {

constexpr const char* dissolved = "";
constexpr const char* many_daughters =
    "its daughters are found faster within it than among the mother's";
constexpr const char* copies =
    "it is placed more than once, and its daughters would be more placements than they are";
constexpr const char* faster_with_it = "rays take less time with it than in the mother";
constexpr const char* sticks_out = "it reaches out of the mother, or might";
constexpr const char* overlaps = "it overlaps another daughter, or might";
constexpr const char* daughters_stick_out = "its daughters reach out of it, or might";
constexpr const char* frame = "its rotation is not orthonormal enough to be combined with others";

/// Rewrites one world, volume by volume.
class Rewriting {
 public:
  Rewriting(const World& world, const Marks& marks, const SmallVolumes& small,
            const ChosenMixtures& mixed, const DissolveOptions& options)
      : original_(world),
        marks_(marks),
        small_(small),
        mixed_(mixed),
        options_(options),
        tolerance_(std::max(least_overlap, 8 * world.tolerance)),
        separation_(tolerance_, world.tolerance),
        within_(world.volumes.size()),
        uses_(world.volumes.size()) {
    result_.world = world;
    for (const LogicalVolume& volume : world.volumes) {
      std::vector<TouchableId>& offsets = result_.offsets.emplace_back();
      for (const Placement& placement : volume.daughters) offsets.push_back(placement.offset);
      result_.gone.emplace_back(volume.daughters.size());
      if (volume.touchables == 0) continue;
      result_.report.placements_before += volume.daughters.size();
      for (const Placement& placement : volume.daughters) ++uses_[placement.volume];
    }
    result_.report.touchables_before = world.volumes[world.top].touchables;
  }

  Dissolved run() {
    for (const VolumeId volume : daughters_first(original_)) rewrite(volume);
    finish(result_.world);
    ObservationReport& report = result_.report;
    for (const LogicalVolume& volume : result_.world.volumes) {
      if (volume.touchables > 0) report.placements_after += volume.daughters.size();
    }
    report.touchables_after = result_.world.volumes[result_.world.top].touchables;
    return std::move(result_);
  }

 private:
  struct Outcome {
    const char* why;  ///< `dissolved`, or why it was kept
    Certainty certainty = Certainty::proved;
  };

  void rewrite(VolumeId mother) {
    const LogicalVolume& was = original_.volumes[mother];
    const auto is_unseen = [&](const Placement& p) {
      return nobody_sees(marks_, small_, p.volume, mother);
    };
    const auto part = mixed_.find(mother);
    if (part == mixed_.end() &&
        std::none_of(was.daughters.begin(), was.daughters.end(), is_unseen)) {
      return;
    }
    std::vector<Extent> boxes;
    for (const Placement& p : was.daughters) {
      boxes.push_back(placed_extent(original_.volumes[p.volume].solid, p.transformation));
    }
    const bvh::BoxTree tree(boxes, tolerance_, bvh::default_method(boxes.size()));
    std::vector<Placement> daughters;
    std::vector<TouchableId> offsets;
    std::map<std::pair<VolumeId, const char*>, std::size_t> entries;
    for (std::size_t k = 0; k < was.daughters.size(); ++k) {
      const Placement& placement = was.daughters[k];
      if (part != mixed_.end() && part->second.contains(placement.volume)) {
        result_.gone[mother][k] = true;
        --uses_[placement.volume];
        continue;
      }
      const std::size_t before = daughters.size();
      Outcome outcome{"", Certainty::no};
      const bool unseen = is_unseen(placement);
      if (unseen) {
        outcome = judge(mother, k, boxes, tree);
        if (outcome.why == dissolved && !replace(placement, daughters, offsets))
          outcome.why = frame;
        note(mother, placement.volume, outcome, entries);
      }
      if (unseen && outcome.why == dissolved) {
        result_.gone[mother][k] = true;
      } else {
        daughters.resize(before);
        offsets.resize(before);
        daughters.push_back(placement);
        offsets.push_back(placement.offset);
      }
    }
    result_.world.volumes[mother].daughters = std::move(daughters);
    result_.offsets[mother] = std::move(offsets);
  }

  /// Whether daughter number k may be dissolved, and whether that pays.
  Outcome judge(VolumeId mother, std::size_t k, const std::vector<Extent>& boxes,
                const bvh::BoxTree& tree) {
    const auto& sisters = original_.volumes[mother].daughters;
    const Placement& placement = sisters[k];
    const VolumeId id = placement.volume;
    const LogicalVolume& volume = original_.volumes[id];
    const std::size_t below = result_.world.volumes[id].daughters.size();
    if (below > options_.most_daughters && sisters.size() > 1) return {many_daughters};
    if (uses_[id] > 1 && below > 1) return {copies};
    if (options_.kept.contains({id, mother})) return {faster_with_it};
    Outcome outcome{dissolved};
    outcome.certainty = weaker(outcome.certainty, daughters_within(id));
    if (outcome.certainty == Certainty::no) return {daughters_stick_out};
    const PlacedSolid placed{volume.solid, placement.transformation};
    outcome.certainty =
        weaker(outcome.certainty, separation_.within(placed, original_.volumes[mother].solid));
    if (outcome.certainty == Certainty::no) return {sticks_out};
    tree.overlapping(boxes[k], [&](std::uint32_t i) {
      if (i == k || !share(boxes[i], boxes[k])) return true;
      const VolumeId other = sisters[i].volume;
      // Both are of the mother's own material, with nothing in them. So it does not matter in which
      // of them a point is.
      if (below == 0 && invisible(marks_, id, mother) && invisible(marks_, other, mother) &&
          result_.world.volumes[other].daughters.empty()) {
        return true;
      }
      outcome.certainty = weaker(
          outcome.certainty,
          separation_.apart(placed, {original_.volumes[other].solid, sisters[i].transformation}));
      return outcome.certainty != Certainty::no;
    });
    if (outcome.certainty == Certainty::no) return {overlaps};
    return outcome;
  }

  bool share(const Extent& a, const Extent& b) const {
    const auto along = [this](double low_a, double high_a, double low_b, double high_b) {
      return std::min(high_a, high_b) - std::max(low_a, low_b) > tolerance_;
    };
    return along(a.min.x, a.max.x, b.min.x, b.max.x) && along(a.min.y, a.max.y, b.min.y, b.max.y) &&
           along(a.min.z, a.max.z, b.min.z, b.max.z);
  }

  /// Whether all that is left in a volume is within the volume; computed once for each volume.
  Certainty daughters_within(VolumeId id) {
    std::optional<Certainty>& known = within_[id];
    if (!known) {
      known = Certainty::proved;
      for (const Placement& p : result_.world.volumes[id].daughters) {
        known =
            weaker(*known, separation_.within({original_.volumes[p.volume].solid, p.transformation},
                                              original_.volumes[id].solid));
        if (*known == Certainty::no) break;
      }
    }
    return *known;
  }

  /// Appends what is left in the placement, in the mother's frame. Returns false if rotations
  /// cannot be combined.
  bool replace(const Placement& placement, std::vector<Placement>& daughters,
               std::vector<TouchableId>& offsets) {
    const auto& inner = result_.world.volumes[placement.volume].daughters;
    try {
      for (std::size_t i = 0; i < inner.size(); ++i) {
        Placement moved = inner[i];
        moved.transformation = compose(placement.transformation, inner[i].transformation);
        moved.name = placement.name + '/' + inner[i].name;
        daughters.push_back(std::move(moved));
        offsets.push_back(placement.offset + result_.offsets[placement.volume][i]);
      }
    } catch (const GeometryError&) {
      return false;
    }
    // A volume with two daughters or more is dissolved only if it is placed once. Then its
    // daughters are placed as often as before.
    --uses_[placement.volume];
    if (uses_[placement.volume] > 0) {
      for (const Placement& p : inner) ++uses_[p.volume];
    }
    return true;
  }

  void note(VolumeId mother, VolumeId volume, const Outcome& outcome,
            std::map<std::pair<VolumeId, const char*>, std::size_t>& entries) {
    ObservationReport& report = result_.report;
    ++report.invisible;
    const bool is_gone = outcome.why == dissolved;
    report.dissolved += is_gone ? 1 : 0;
    report.sampled += is_gone && outcome.certainty == Certainty::sampled ? 1 : 0;
    auto& list = is_gone ? report.gone : report.left;
    const auto [entry, fresh] = entries.try_emplace({volume, outcome.why}, list.size());
    if (fresh) {
      const auto change = small_.find({volume, mother});
      if (is_gone && change != small_.end()) report.bound += change->second;
      list.push_back({original_.volumes[volume].name, original_.volumes[mother].name, 0,
                      change == small_.end() ? 0 : change->second, outcome.why});
    }
    ++list[entry->second].placements;
  }

  const World& original_;
  const Marks& marks_;
  const SmallVolumes& small_;
  const ChosenMixtures& mixed_;
  DissolveOptions options_;
  double tolerance_;
  Separation separation_;
  std::vector<std::optional<Certainty>> within_;
  std::vector<std::uint64_t> uses_;  ///< placements of each volume in the present tree
  Dissolved result_;
};

}  // namespace

Dissolved dissolve(const World& world, const Marks& marks, const SmallVolumes& small,
                   const ChosenMixtures& mixed, const DissolveOptions& options) {
  require_finished(&world);
  return Rewriting(world, marks, small, mixed, options).run();
}

}  // namespace navjit
