#include "apps/accuracy/figures.hpp"

#include <algorithm>
#include <cmath>

namespace navjit::accuracy {
namespace {

constexpr std::size_t worst_kept = 10;

template <class T>
void append_to(std::vector<T>& a, const std::vector<T>& b) {
  a.insert(a.end(), b.begin(), b.end());
}

double across_ulp(const WorstStep& w) { return w.judged.across / w.judged.ulp; }
double along_ulp(const WorstStep& w) { return w.judged.error / w.judged.ulp; }

template <class Badness>
void keep_worst(std::vector<WorstStep>& list, Badness badness) {
  // Stable, and ties by ray: the same list however threads shared the work.
  std::stable_sort(list.begin(), list.end(), [&](const WorstStep& a, const WorstStep& b) {
    return badness(a) != badness(b) ? badness(a) > badness(b) : a.ray_index < b.ray_index;
  });
  if (list.size() > worst_kept) list.resize(worst_kept);
}

/// Whether a step would be among the worst.
template <class Badness>
bool enters(const std::vector<WorstStep>& list, const WorstStep& step, Badness badness) {
  return list.size() < worst_kept || badness(step) >= badness(list.back());
}

}  // namespace

Quantiles quantiles(std::vector<float> values) {
  if (values.empty()) return {};
  const auto at = [&](double q) {
    const auto n =
        static_cast<std::ptrdiff_t>(std::ceil(q * static_cast<double>(values.size()))) - 1;
    const auto nth = values.begin() + std::max<std::ptrdiff_t>(n, 0);
    std::nth_element(values.begin(), nth, values.end());
    return static_cast<double>(*nth);
  };
  return {at(0.5), at(0.999), at(1)};
}

void Errors::add(const JudgedStep& step) {
  along_mm.push_back(static_cast<float>(step.error));
  along_ulp.push_back(static_cast<float>(step.error / step.ulp));
  across_ulp.push_back(static_cast<float>(step.across / step.ulp));
}

void Errors::append(const Errors& other) {
  append_to(along_mm, other.along_mm);
  append_to(along_ulp, other.along_ulp);
  append_to(across_ulp, other.across_ulp);
}

void StepFigures::add(const JudgedStep& step) {
  ++steps;
  wrong_volume += step.wrong_volume ? 1 : 0;
  wrong_end += step.wrong_end ? 1 : 0;
  if (step.measured) errors.add(step);
}

void StepFigures::append(const StepFigures& other) {
  steps += other.steps;
  wrong_volume += other.wrong_volume;
  wrong_end += other.wrong_end;
  errors.append(other.errors);
}

void EngineFigures::add(const World& world, const Ray& ray, const MadeRay& ray_made,
                        const JudgedRay& judged) {
  ++rays;
  outside += ray_made.steps.empty() ? 1 : 0;
  made += ray_made.steps.size();
  stuck += judged.stuck ? 1 : 0;
  lost += judged.lost ? 1 : 0;
  skipped += judged.skipped;
  arguable += judged.arguable;
  if ((judged.stuck || judged.lost) && given_up.size() < worst_kept) {
    WorstStep w{{}, ray, ray_made.index, ray_made.end, 0, judged.stuck ? "stuck" : "lost"};
    if (!ray_made.steps.empty()) {
      const MadeStep& last = ray_made.steps.back();
      w.judged.step = ray_made.steps.size() - 1;
      w.claim += " in " + (last.touchable ? path_of(world, *last.touchable) : last.volume);
    }
    given_up.push_back(std::move(w));
  }
  for (const JudgedStep& step : judged.steps) {
    all.add(step);
    scenes[step.volume].add(step);
    surfaces[world.volumes[step.surface].solid.kind].add(step);
    const MadeStep& m = ray_made.steps[step.step];
    WorstStep w{step, ray, ray_made.index, m.point, m.length, ""};
    const bool bad = step.wrong_volume || step.wrong_end;
    const bool far = step.measured && step.across > step.ulp && enters(worst_across, w, across_ulp);
    const bool off = step.measured && step.error > step.ulp && enters(worst_along, w, along_ulp);
    if (!bad && !far && !off) continue;
    w.claim = m.touchable ? path_of(world, *m.touchable) : m.volume;
    if (bad && wrong.size() < worst_kept) wrong.push_back(w);
    if (far) {
      worst_across.push_back(w);
      keep_worst(worst_across, across_ulp);
    }
    if (off) {
      worst_along.push_back(w);
      keep_worst(worst_along, along_ulp);
    }
  }
}

void EngineFigures::hold_against(const std::vector<ErrorBound>& bounds, const JudgedRay& judged) {
  for (const JudgedStep& step : judged.steps) {
    const ErrorBound& bound = bounds[step.volume];
    if (!step.measured || !bound.known()) continue;
    ++bounded;
    beyond_bound += step.across > bound.total() ? 1 : 0;
    largest_part = std::max(largest_part, step.across / bound.total());
  }
}

void EngineFigures::append(const EngineFigures& o) {
  rays += o.rays;
  outside += o.outside;
  made += o.made;
  equal += o.equal;
  stuck += o.stuck;
  lost += o.lost;
  skipped += o.skipped;
  arguable += o.arguable;
  bounded += o.bounded;
  beyond_bound += o.beyond_bound;
  largest_part = std::max(largest_part, o.largest_part);
  all.append(o.all);
  for (const auto& [volume, figures] : o.scenes) scenes[volume].append(figures);
  for (const auto& [kind, figures] : o.surfaces) surfaces[kind].append(figures);
  append_to(worst_across, o.worst_across);
  append_to(worst_along, o.worst_along);
  append_to(wrong, o.wrong);
  append_to(given_up, o.given_up);
  keep_worst(worst_across, across_ulp);
  keep_worst(worst_along, along_ulp);
  keep_worst(wrong, along_ulp);
  keep_worst(given_up, [](const WorstStep&) { return 0.0; });
}

}  // namespace navjit::accuracy
