#include "apps/warmup/series.hpp"

#include <algorithm>

namespace navjit::warmup {

namespace {

double value_at(const Series& series, double seconds, double Point::*value) {
  const auto after = std::lower_bound(series.begin(), series.end(), seconds,
                                      [](const Point& p, double t) { return p.seconds < t; });
  if (after == series.end()) return series.empty() ? 0 : series.back().*value;
  if (after->seconds == seconds) return (*after).*value;
  if (after == series.begin()) return 0;
  const Point& before = *(after - 1);
  const double part = (seconds - before.seconds) / (after->seconds - before.seconds);
  return before.*value + part * ((*after).*value - before.*value);
}

}  // namespace

double steps_at(const Series& series, double seconds) {
  return value_at(series, seconds, &Point::steps);
}

double processor_rate(const Series& series, double from, double to) {
  const double processor_s =
      value_at(series, to, &Point::processor_s) - value_at(series, from, &Point::processor_s);
  return processor_s > 0 ? (steps_at(series, to) - steps_at(series, from)) / processor_s : 0;
}

double rate(const Series& series, double from, double to) {
  return to > from ? (steps_at(series, to) - steps_at(series, from)) / (to - from) : 0;
}

std::optional<double> break_even(const Series& run, const Series& baseline) {
  if (run.empty() || baseline.empty()) return std::nullopt;
  const double end = std::min(run.back().seconds, baseline.back().seconds);
  // The difference is linear between any two of these.
  std::vector<double> times{0, end};
  for (const Series* series : {&run, &baseline}) {
    for (const Point& p : *series) {
      if (p.seconds > 0 && p.seconds < end) times.push_back(p.seconds);
    }
  }
  std::sort(times.begin(), times.end());
  const auto ahead = [&](double t) { return steps_at(run, t) - steps_at(baseline, t); };
  double later = end, ahead_later = ahead(end);
  if (ahead_later < 0) return std::nullopt;
  for (auto t = times.rbegin(); t != times.rend(); ++t) {
    const double ahead_now = ahead(*t);
    if (ahead_now < 0) return *t + (later - *t) * (-ahead_now / (ahead_later - ahead_now));
    later = *t;
    ahead_later = ahead_now;
  }
  return 0;
}

double share_at(const std::vector<Swap>& swaps, double seconds) {
  double share = 0;
  for (const Swap& swap : swaps) share += swap.seconds <= seconds ? swap.share : 0;
  return share;
}

std::optional<double> time_of_share(const std::vector<Swap>& swaps, double share) {
  std::vector<Swap> in_order = swaps;
  std::sort(in_order.begin(), in_order.end(),
            [](const Swap& a, const Swap& b) { return a.seconds < b.seconds; });
  double sum = 0;
  for (const Swap& swap : in_order) {
    sum += swap.share;
    if (sum >= share) return swap.seconds;
  }
  return std::nullopt;
}

Spread spread(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  const double median = n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
  return {median, values.front(), values.back()};
}

}  // namespace navjit::warmup
