#include "observe/worth_dissolving.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/model/order.hpp"

namespace navjit {
namespace {

/// The time of a step in a volume with so many daughters, in units of a step in a leaf. A guess,
/// from scenes of LHCb's calorimeters (a leaf 20 ns, eight daughters 47) and of the CMS preshower
/// (70 and, with 287 daughters, 560).
double cost_of_step(double daughters) { return 1 + 0.6 * std::log2(1 + std::max(daughters, 0.0)); }

/// If a mother has more volumes than this to choose from, all of them are dissolved or none.
constexpr std::size_t most_to_choose_from = 64;

/// The tree as it is being changed, from the leaves up, and the steps of rays in it.
class Thinning {
 public:
  Thinning(const World& world, const Passages& passages)
      : world_(world),
        passages_(passages),
        nodes_of_(world.volumes.size()),
        daughters_of_(passages.nodes.size()),
        boundaries_of_(passages.nodes.size()),
        daughters_(world.volumes.size()),
        uses_(world.volumes.size()) {
    for (std::uint32_t n = 0; n < passages.nodes.size(); ++n) {
      const PassedNode& node = passages.nodes[n];
      nodes_of_[node.volume].push_back(n);
      if (n > 0) daughters_of_[node.mother].push_back(n);
      parts_.push_back({n});
      top_.push_back(n);
    }
    for (const PassedBoundaries& b : passages.boundaries) boundaries_of_[b.from].push_back(&b);
    for (VolumeId v = 0; v < world.volumes.size(); ++v) {
      daughters_[v] = static_cast<double>(world.volumes[v].daughters.size());
      if (world.volumes[v].touchables == 0) continue;
      for (const Placement& p : world.volumes[v].daughters) ++uses_[p.volume];
    }
  }

  /// Whether dissolve() keeps a volume because of its daughters.
  bool is_kept_anyway(VolumeId volume, VolumeId mother, std::size_t most_daughters) const {
    const bool alone = world_.volumes[mother].daughters.size() == 1;
    return (daughters_[volume] > static_cast<double>(most_daughters) && !alone) ||
           (uses_[volume] > 1 && daughters_[volume] > 1);
  }

  /// Those of the daughters' volumes that should be dissolved.
  std::set<VolumeId> choose(VolumeId mother, const std::vector<VolumeId>& volumes) const {
    const Steps steps = steps_in(mother, volumes);
    std::vector<bool> chosen(volumes.size(), true);
    double best = cost(steps, mother, volumes, chosen);
    for (bool better = volumes.size() <= most_to_choose_from; better;) {
      better = false;
      std::size_t worst = 0;
      for (std::size_t i = 0; i < volumes.size(); ++i) {
        if (!chosen[i]) continue;
        chosen[i] = false;
        const double without = cost(steps, mother, volumes, chosen);
        chosen[i] = true;
        if (!(without < best)) continue;
        best = without;
        worst = i;
        better = true;
      }
      if (better) chosen[worst] = false;
    }
    const std::vector<bool> none(volumes.size(), false);
    if (cost(steps, mother, volumes, none) < best) chosen = none;
    std::set<VolumeId> to_go;
    for (std::size_t i = 0; i < volumes.size(); ++i) {
      if (chosen[i]) to_go.insert(volumes[i]);
    }
    return to_go;
  }

  void dissolve(VolumeId mother, const std::set<VolumeId>& volumes) {
    daughters_[mother] = daughters_without(mother, volumes);
    for (const std::uint32_t m : nodes_of_[mother]) {
      for (const std::uint32_t d : daughters_of_[m]) {
        if (!volumes.contains(passages_.nodes[d].volume)) continue;
        for (const std::uint32_t part : parts_[d]) top_[part] = m;
        parts_[m].insert(parts_[m].end(), parts_[d].begin(), parts_[d].end());
        parts_[d].clear();
      }
    }
  }

 private:
  /// Steps in a mother and its daughters. Index 0 is the mother; the others are the daughters'
  /// volumes in their order.
  struct Steps {
    std::vector<std::uint64_t> made;
    std::map<std::pair<std::size_t, std::size_t>, std::uint64_t> between;  ///< within a mother
  };

  Steps steps_in(VolumeId mother, const std::vector<VolumeId>& volumes) const {
    Steps steps{std::vector<std::uint64_t>(volumes.size() + 1), {}};
    std::map<std::uint32_t, std::size_t> number;  // of nodes
    for (const std::uint32_t m : nodes_of_[mother]) {
      number[m] = 0;
      for (const std::uint32_t d : daughters_of_[m]) {
        const auto found = std::find(volumes.begin(), volumes.end(), passages_.nodes[d].volume);
        if (found == volumes.end()) continue;
        number[d] = 1 + static_cast<std::size_t>(found - volumes.begin());
      }
    }
    for (const auto& [node, n] : number) {
      const std::uint32_t depth = passages_.nodes[node].depth;
      for (const std::uint32_t part : parts_[node]) {
        for (const PassedBoundaries* b : boundaries_of_[part]) {
          const auto to = number.find(top_[b->to]);
          if (top_[b->to] == node && b->common >= depth)
            continue;  // this boundary has disappeared already
          steps.made[n] += b->count;
          const std::uint32_t mother_depth = n == 0 ? depth : depth - 1;
          if (to != number.end() && b->common >= mother_depth) {
            steps.between[{n, to->second}] += b->count;
          }
        }
      }
    }
    return steps;
  }

  double daughters_without(VolumeId mother, const std::set<VolumeId>& volumes) const {
    double count = daughters_[mother];
    for (const Placement& p : world_.volumes[mother].daughters) {
      if (volumes.contains(p.volume)) count += daughters_[p.volume] - 1;
    }
    return count;
  }

  double cost(const Steps& steps, VolumeId mother, const std::vector<VolumeId>& volumes,
              const std::vector<bool>& chosen) const {
    const auto is_mothers = [&](std::size_t n) { return n == 0 || chosen[n - 1]; };
    auto mothers = static_cast<double>(steps.made[0]);
    double others = 0;
    std::set<VolumeId> gone;
    for (std::size_t i = 0; i < volumes.size(); ++i) {
      const auto made = static_cast<double>(steps.made[i + 1]);
      if (chosen[i]) {
        mothers += made;
        gone.insert(volumes[i]);
      } else {
        others += made * cost_of_step(daughters_[volumes[i]]);
      }
    }
    for (const auto& [pair, count] : steps.between) {
      if (is_mothers(pair.first) && is_mothers(pair.second)) mothers -= static_cast<double>(count);
    }
    return mothers * cost_of_step(daughters_without(mother, gone)) + others;
  }

  const World& world_;
  const Passages& passages_;
  std::vector<std::vector<std::uint32_t>> nodes_of_;                 ///< by volume
  std::vector<std::vector<std::uint32_t>> daughters_of_;             ///< by node
  std::vector<std::vector<const PassedBoundaries*>> boundaries_of_;  ///< by node that is left
  std::vector<double> daughters_;                  ///< by volume, in the present tree
  std::vector<std::uint64_t> uses_;                ///< by volume
  std::vector<std::vector<std::uint32_t>> parts_;  ///< by node: itself, and its parts
  std::vector<std::uint32_t> top_;                 ///< by node: the node that it is part of
};

}  // namespace

bool anything_unseen(const World& world, const Marks& marks, const SmallVolumes& small) {
  for (VolumeId mother = 0; mother < world.volumes.size(); ++mother) {
    if (world.volumes[mother].touchables == 0) continue;
    for (const Placement& p : world.volumes[mother].daughters) {
      if (nobody_sees(marks, small, p.volume, mother)) return true;
    }
  }
  return false;
}

Pairs better_kept(const World& world, const Marks& marks, const SmallVolumes& small,
                  const Passages& passages, std::size_t most_daughters) {
  Thinning tree(world, passages);
  Pairs kept;
  for (const VolumeId mother : daughters_first(world)) {
    std::set<VolumeId> unseen;
    for (const Placement& p : world.volumes[mother].daughters) {
      if (nobody_sees(marks, small, p.volume, mother) &&
          !tree.is_kept_anyway(p.volume, mother, most_daughters)) {
        unseen.insert(p.volume);
      }
    }
    if (unseen.empty()) continue;
    const std::set<VolumeId> gone = tree.choose(mother, {unseen.begin(), unseen.end()});
    tree.dissolve(mother, gone);
    for (const VolumeId volume : unseen) {
      if (!gone.contains(volume)) kept.insert({volume, mother});
    }
  }
  return kept;
}

}  // namespace navjit
