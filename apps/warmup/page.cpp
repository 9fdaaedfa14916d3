#include "apps/warmup/page.hpp"

#include <optional>

#include "apps/warmup/picture.hpp"
#include "common/page.hpp"

namespace navjit::warmup {
namespace {

using common::Cell;

/// The median of those runs that have a value.
template <class Get>
Cell median(const VariantReport& report, const char* format, Get&& get) {
  std::vector<double> values;
  for (const RunFigures& run : report.runs) {
    if (const std::optional<double> value = get(run)) values.push_back(*value);
  }
  return values.empty() ? Cell{"-"} : common::measured(spread(values).median, format);
}

std::string table_of(const ExperimentReport& report) {
  std::vector<std::vector<Cell>> rows;
  for (const VariantReport& each : report.variants) {
    const auto cell = [&](const char* format, auto&& get) { return median(each, format, get); };
    using Value = std::optional<double>;
    rows.push_back(
        {{each.variant.name},
         common::counted(each.runs.size()),
         cell("%.3f", [](const RunFigures& r) { return Value(r.steps_per_second / 1e6); }),
         cell("%.2f", [](const RunFigures& r) { return Value(r.speed_up); }),
         cell("%.2f", [](const RunFigures& r) { return r.break_even_s; }),
         cell("%.3f", [](const RunFigures& r) { return r.half_s; }),
         cell("%.3f", [](const RunFigures& r) { return r.most_s; }),
         cell("%.0f%%", [](const RunFigures& r) { return Value(100 * r.share); }),
         cell("%.2f", [](const RunFigures& r) { return Value(r.record.other_s); })});
  }
  return common::table_html(
      {"run", "repetitions", "million steps/s", "speed-up in the end", "break-even, s",
       "50% of steps specialised, s", "90%, s", "share in the end", "cost, s of processor"},
      rows);
}

}  // namespace

std::string page(const ExperimentReport& report, const std::string& title,
                 const std::vector<std::pair<std::string, std::string>>& facts) {
  common::Chart speed{"seconds since the start", "million steps a second", {}};
  common::Chart share{"seconds since the start", "steps specialised, %", {}};
  for (const Curve& curve : curves_of(report)) {
    common::ChartLine rates{curve.variant.name, {}}, shares{curve.variant.name, {}};
    for (const Curve::Moment& at : curve.moments) {
      rates.points.emplace_back(at.seconds, at.million_steps_per_second);
      shares.points.emplace_back(at.seconds, at.percent_specialised);
    }
    speed.lines.push_back(std::move(rates));
    share.lines.push_back(std::move(shares));
  }
  return common::page_html(
      "navjit warmup: " + title,
      common::paragraph_html(
          std::string(
              "The same rays without the JIT (off), and with it in several ways, each run a "
              "process of its own, in turn. Medians over repetitions.") +
          (report.interrupted ? " The experiment was interrupted." : "") +
          (report.failure.empty() ? "" : " It ended early: " + report.failure + ".")) +
          table_of(report) + common::heading_html("Speed against time") +
          common::chart_html(speed) +
          common::heading_html("Share of the steps in specialised scenes") +
          common::chart_html(share) + common::heading_html("Command and machine") +
          common::facts_html(facts));
}

}  // namespace navjit::warmup
