#include "observe/choose_mixtures.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <queue>

namespace navjit {
namespace {

/// The parts of sorted records that belong to each node.
template <class Record, class Key>
std::vector<std::span<const Record>> by_node(const std::vector<Record>& records, std::size_t nodes,
                                             const Key& key) {
  std::vector<std::span<const Record>> parts(nodes);
  for (std::size_t first = 0; first < records.size();) {
    std::size_t last = first;
    while (last < records.size() && key(records[last]) == key(records[first])) ++last;
    parts[key(records[first])] = {records.data() + first, last - first};
    first = last;
  }
  return parts;
}

/// A choice as it grows, and its effect on rays.
class Choice {
 public:
  Choice(const World& world, const Mixtures& mixtures, const std::vector<double>& rates,
         const Passages& passages)
      : mixtures_(mixtures),
        passages_(passages),
        lengths_(by_node(passages.lengths, passages.nodes.size(),
                         [](const PassedLength& l) { return l.node; })),
        boundaries_(by_node(passages.boundaries, passages.nodes.size(),
                            [](const PassedBoundaries& b) { return b.from; })),
        daughters_(passages.nodes.size()),
        nodes_of_(world.volumes.size()),
        changes_(passages.rays),
        touched_(passages.rays) {
    for (std::uint32_t n = 0; n < passages.nodes.size(); ++n) {
      const PassedNode& node = passages.nodes[n];
      nodes_of_[node.volume].push_back(n);
      if (n > 0) daughters_[node.mother].push_back(n);
      const std::uint32_t material = world.volumes[node.volume].material;
      own_.push_back(material < rates.size() ? std::max(rates[material], 0.0) : 0);
      ends_.push_back(node.depth);
    }
    rates_ = own_;
  }

  /// The effect of the choice if the daughters of these volumes became part of the mother as well.
  struct Trial {
    double mean = 0;         ///< the mean absolute change of all rays
    std::uint64_t gain = 0;  ///< boundaries that rays would not see any more
  };
  Trial try_out(VolumeId mother, const std::set<VolumeId>& more) {
    Trial trial;
    const auto all = with(mother, more);
    const double rate = mixtures_.rate(mother, all);
    double sum = sum_;
    rays_.clear();
    find_affected(mother, all);
    for (const Affected& a : affected_) {
      for (const PassedLength& l : lengths_[a.node]) {
        if (touched_[l.ray] == 0) rays_.push_back(l.ray);
        touched_[l.ray] += l.length * (rate - rates_[a.node]);
      }
      trial.gain -= vanished(a.node);
    }
    for (const Affected& a : affected_) ends_[a.node] = a.after;
    for (const Affected& a : affected_) trial.gain += vanished(a.node);
    for (const Affected& a : affected_) ends_[a.node] = a.before;
    for (const std::uint32_t ray : rays_) {
      sum += std::abs(changes_[ray] + touched_[ray]) - std::abs(changes_[ray]);
      touched_[ray] = 0;
    }
    trial.mean = sum / static_cast<double>(std::max<std::size_t>(changes_.size(), 1));
    return trial;
  }

  void take(VolumeId mother, const std::set<VolumeId>& more) {
    const auto all = with(mother, more);
    const double rate = mixtures_.rate(mother, all);
    find_affected(mother, all);
    for (const Affected& a : affected_) {
      for (const PassedLength& l : lengths_[a.node]) {
        changes_[l.ray] += l.length * (rate - rates_[a.node]);
      }
      rates_[a.node] = rate;
      ends_[a.node] = a.after;
    }
    chosen_[mother] = all;
    sum_ = 0;
    for (const double change : changes_) sum_ += std::abs(change);
  }

  double mean() const {
    return sum_ / static_cast<double>(std::max<std::size_t>(changes_.size(), 1));
  }
  const std::vector<double>& changes() const { return changes_; }
  const ChosenMixtures& chosen() const { return chosen_; }
  bool passed(VolumeId volume) const { return !nodes_of_[volume].empty(); }
  double whole() const {
    double sum = 0;
    for (const PassedLength& l : passages_.lengths) sum += l.length * own_[l.node];
    return sum / static_cast<double>(std::max<std::size_t>(passages_.rays, 1));
  }

 private:
  std::set<VolumeId> with(VolumeId mother, const std::set<VolumeId>& more) const {
    const auto found = chosen_.find(mother);
    std::set<VolumeId> all = found == chosen_.end() ? std::set<VolumeId>{} : found->second;
    all.insert(more.begin(), more.end());
    return all;
  }

  /// Finds all nodes of the mother that are not part of a mixture themselves, and all nodes below
  /// them that become part of their mixtures.
  void find_affected(VolumeId mother, const std::set<VolumeId>& all) {
    affected_.clear();
    for (const std::uint32_t node : nodes_of_[mother]) {
      const std::uint32_t depth = passages_.nodes[node].depth;
      if (ends_[node] < depth) continue;
      affected_.push_back({node, ends_[node], depth});
      for (const std::uint32_t d : daughters_[node]) {
        if (all.contains(passages_.nodes[d].volume)) add_below(d, depth);
      }
    }
  }
  void add_below(std::uint32_t node, std::uint32_t depth) {
    affected_.push_back({node, ends_[node], depth});
    for (const std::uint32_t d : daughters_[node]) add_below(d, depth);
  }

  /// The number of boundaries from a node that are within one mixture.
  std::uint64_t vanished(std::uint32_t node) const {
    std::uint64_t sum = 0;
    for (const PassedBoundaries& b : boundaries_[node]) {
      if (ends_[b.from] == ends_[b.to] && ends_[b.from] <= b.common) sum += b.count;
    }
    return sum;
  }

  const Mixtures& mixtures_;
  const Passages& passages_;
  std::vector<std::span<const PassedLength>> lengths_;
  std::vector<std::span<const PassedBoundaries>> boundaries_;
  std::vector<std::vector<std::uint32_t>> daughters_, nodes_of_;
  std::vector<double> own_, rates_;  ///< by node: the original rate, and the present one
  std::vector<std::uint32_t> ends_;  ///< by node: depth of the volume of which it is now a part
  std::vector<double> changes_, touched_;  ///< by ray
  std::vector<std::uint32_t> rays_;
  struct Affected {
    std::uint32_t node, before, after;  ///< the values of `ends_`
  };
  std::vector<Affected> affected_;
  double sum_ = 0;
  ChosenMixtures chosen_;
};

struct Move {
  double score = 0;
  VolumeId mother = 0;
  std::set<VolumeId> daughters{};
  std::size_t since = never;  ///< how many moves had been taken when it was judged

  static constexpr std::size_t never = static_cast<std::size_t>(-1);

  bool operator<(const Move& other) const { return score < other.score; }
};

/// The choice without mothers that are part of other mixtures wherever they are placed.
ChosenMixtures without_hidden(const World& world, const ChosenMixtures& chosen) {
  ChosenMixtures left;
  std::vector<bool> seen(world.volumes.size());
  std::vector<VolumeId> open{world.top};
  seen[world.top] = true;
  while (!open.empty()) {
    const VolumeId v = open.back();
    open.pop_back();
    const auto mixed = chosen.find(v);
    if (mixed != chosen.end()) left.insert(*mixed);
    for (const Placement& p : world.volumes[v].daughters) {
      if (seen[p.volume] || (mixed != chosen.end() && mixed->second.contains(p.volume))) continue;
      seen[p.volume] = true;
      open.push_back(p.volume);
    }
  }
  return left;
}

std::vector<Move> all_moves(const Mixtures& mixtures, const Choice& choice) {
  std::vector<Move> moves;
  for (VolumeId v = 0; v < mixtures.possible().size(); ++v) {
    const std::set<VolumeId>& possible = mixtures.possible()[v];
    if (possible.empty() || !choice.passed(v)) continue;
    moves.push_back({INFINITY, v, possible});
    if (possible.size() == 1) continue;
    for (const VolumeId d : possible) {
      if (choice.passed(d)) moves.push_back({INFINITY, v, {d}});
    }
  }
  return moves;
}

}  // namespace

RayChanges changes_of(const World& world, const Mixtures& mixtures,
                      const std::vector<double>& rates, const Passages& passages,
                      const ChosenMixtures& chosen) {
  Choice choice(world, mixtures, rates, passages);
  // The order does not matter: a part of another mixture remains one.
  for (const auto& [mother, daughters] : chosen) choice.take(mother, daughters);
  RayChanges changes{.whole = choice.whole()};
  std::vector<double> sizes;
  double squares = 0, signed_squares = 0;
  for (const double c : choice.changes()) {
    sizes.push_back(std::abs(c));
    changes.mean += std::abs(c);
    changes.signed_mean += c;
    squares += c * c;
  }
  if (sizes.empty()) return changes;
  const auto count = static_cast<double>(sizes.size());
  changes.mean /= count;
  changes.signed_mean /= count;
  signed_squares = squares / count - changes.signed_mean * changes.signed_mean;
  squares = squares / count - changes.mean * changes.mean;
  changes.error = std::sqrt(std::max(squares, 0.0) / count);
  changes.signed_error = std::sqrt(std::max(signed_squares, 0.0) / count);
  std::sort(sizes.begin(), sizes.end());
  const auto at = [&](double share) {
    return sizes[static_cast<std::size_t>(share * (count - 1))];
  };
  changes.of_99 = at(0.99);
  changes.of_999 = at(0.999);
  changes.largest = sizes.back();
  return changes;
}

ChosenMixtures choose_mixtures(const World& world, const Mixtures& mixtures,
                               const std::vector<double>& rates, const Passages& passages,
                               double mean) {
  Choice choice(world, mixtures, rates, passages);
  std::priority_queue<Move> queue(std::less<Move>{}, all_moves(mixtures, choice));
  std::size_t taken = 0;
  while (!queue.empty()) {
    Move move = queue.top();
    queue.pop();
    const bool judged = move.since == taken;
    const Choice::Trial trial = choice.try_out(move.mother, move.daughters);
    // A move that changes rays too much now does so later as well, unless changes cancel.
    if (trial.mean > mean || trial.gain == 0) continue;
    if (judged) {
      choice.take(move.mother, move.daughters);
      ++taken;
      continue;
    }
    // A move that brings rays nearer to the original costs least of all.
    const double cost = std::max(trial.mean - choice.mean(), 1e-12 * (mean + choice.mean()));
    move.score = static_cast<double>(trial.gain) / cost;
    move.since = taken;
    queue.push(std::move(move));
  }
  return without_hidden(world, choice.chosen());
}

}  // namespace navjit
