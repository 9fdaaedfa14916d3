#include "runtime/trials.hpp"

#include <algorithm>
#include <cmath>

#include "navjit/navigator.hpp"

namespace navjit {
namespace {

/// The pairs of stretches that a verdict needs. Fewer do not show how much pairs differ.
constexpr double least_pairs = 8;
/// The timed steps of either side that a verdict needs. Steps may take many different ways through
/// the code, so fewer say little.
constexpr double least_count = 50;
/// The number of standard errors by which two sides must differ to be called different.
constexpr double errors_apart = 2.5;
/// After this many steps a difference by chance is small.
constexpr double enough_count = 5000;

/// The verdict at the end of a trial, by the mean alone, although this may be chance. A candidate
/// that lost more than it may goes, and so does one that has to be proved unless it was faster.
Verdict at_last(const PairedDifference& lost, const Trial& t) {
  const bool slower = lost.mean() > t.allowed, faster = lost.mean() < 0;
  return slower || (t.to_be_proved && !faster) ? Verdict::goes : Verdict::stays;
}

Verdict verdict_on(const Trial& t) {
  if (t.is_rare()) return Verdict::open;
  const double lost = t.lost.mean() - t.allowed, error = t.lost.error();
  if (lost < -errors_apart * error) return Verdict::stays;
  if (lost > errors_apart * error) return Verdict::goes;
  if (std::min(t.with.count, t.without.count) < enough_count) return Verdict::open;
  return at_last(t.lost, t);
}

}  // namespace

bool Trial::is_rare() const {
  return std::min(with.count, without.count) < least_count || lost.pairs < least_pairs;
}

void TickSum::add(double ticks, double usual) {
  constexpr double far = 8;
  if (usual > 0) ticks = std::min(ticks, far * usual);
  ++count;
  sum += ticks;
}

void PairedDifference::add(const TickSum& a, const TickSum& b) {
  const double difference = a.mean() - b.mean();
  const double w = a.count * b.count / (a.count + b.count);
  add({1, w, w * difference, w * w, w * w * difference, w * w * difference * difference});
}

void PairedDifference::add(const PairedDifference& more) {
  pairs += more.pairs;
  weight += more.weight;
  sum += more.sum;
  weight2 += more.weight2;
  sum2 += more.sum2;
  squares2 += more.squares2;
}

double PairedDifference::error() const {
  if (weight == 0) return 0;
  const double m = mean();
  return std::sqrt(std::max(squares2 - 2 * m * sum2 + m * m * weight2, 0.0)) / weight;
}

void Trials::begin(VolumeId volume, Trial trial, double now) {
  Trial& at = trials_[volume];
  if (at.candidate == nullptr || at.verdict != Verdict::open) {
    if (open_++ == 0) opened_ = now;
  }
  at = std::move(trial);
  at.began = now;
}

void Trials::end(VolumeId volume) {
  const auto found = trials_.find(volume);
  if (found == trials_.end()) return;
  if (found->second.verdict == Verdict::open) --open_;
  trials_.erase(found);
}

bool Trials::take_out(VolumeId volume, const kernels::DispatchEntry* instead,
                      std::shared_ptr<const void> owner) {
  const auto found = trials_.find(volume);
  if (found == trials_.end()) return false;
  Trial& trial = found->second;
  if (trial.verdict == Verdict::open) --open_;
  trial.before = instead;
  trial.before_owner = std::move(owner);
  trial.verdict = Verdict::goes;
  trial.out = true;
  return true;
}

void Trials::take_in(VolumeId volume) {
  const auto found = trials_.find(volume);
  if (found == trials_.end() || found->second.verdict != Verdict::goes) return;
  found->second.verdict = Verdict::stays;
  found->second.out = false;
}

void Trials::record(VolumeId volume, const kernels::DispatchEntry* used, double ticks) {
  const auto found = trials_.find(volume);
  if (found == trials_.end() || found->second.verdict != Verdict::open) return;
  Trial& trial = found->second;
  const bool with = used == trial.candidate;
  if (!with && used != trial.before) return;
  TickSum& all = with ? trial.with : trial.without;
  const double usual = all.count >= 8 ? all.mean() : 0;
  all.add(ticks, usual);
  (with ? trial.with_now : trial.without_now).add(ticks, usual);
}

std::vector<Trials::Of> Trials::decide(double now) {
  std::vector<Of> decided;
  std::vector<Trial*> few;
  for (auto& [volume, trial] : trials_) {
    if (trial.verdict != Verdict::open) continue;
    // A rare scene may need several stretches for a pair.
    if (trial.with_now.count > 0 && trial.without_now.count > 0) {
      trial.lost.add(trial.with_now, trial.without_now);
      trial.with_now = trial.without_now = {};
    }
    trial.verdict = verdict_on(trial);
    if (trial.verdict == Verdict::open) {
      if (!(now - trial.began > most_s)) continue;
      if (trial.is_rare()) {
        few.push_back(&trial);
      } else {
        trial.verdict = at_last(trial.lost, trial);
      }
    }
    decided.push_back({volume, &trial});
  }
  judge_as_others(few);
  open_ -= decided.size();
  if (!decided.empty() && open_ == 0) spent_ += now - opened_;
  return decided;
}

void Trials::judge_as_others(const std::vector<Trial*>& few) {
  if (few.empty()) return;
  // Both sides must be the same: a navigator that is faster than the generic one need not be faster
  // than another way to bind the scene.
  using Sides = std::pair<kernels::StepFunction, kernels::StepFunction>;
  const auto sides = [](const Trial& t) { return Sides{t.candidate->step, t.before->step}; };
  std::map<Sides, PairedDifference> lost;
  for (const auto& [volume, trial] : trials_) lost[sides(trial)].add(trial.lost);
  for (Trial* trial : few) trial->verdict = at_last(lost[sides(*trial)], *trial);
}

std::vector<Trials::Of> Trials::begin_again(double now) {
  std::vector<Of> begun;
  if (open_ > 0 || trials_.empty() || spent_ > most_share * now) return begun;
  for (auto& [volume, trial] : trials_) {
    trial.verdict = Verdict::open;
    trial.with = trial.without = trial.with_now = trial.without_now = {};
    trial.lost = {};
    trial.began = now;
    begun.push_back({volume, &trial});
  }
  open_ = begun.size();
  opened_ = now;
  return begun;
}

}  // namespace navjit
