#include "apps/warmup/page.hpp"

#include "apps/warmup/columns.hpp"
#include "apps/warmup/picture.hpp"
#include "common/page.hpp"

namespace navjit::warmup {
namespace {

using common::Cell;

std::string table_of(const ExperimentReport& report) {
  std::vector<std::string> all{"run", "repetitions"};
  for (const std::string& heading : headings()) all.push_back(heading);
  std::vector<std::vector<Cell>> rows;
  for (const VariantReport& each : report.variants) {
    std::vector<Cell> row{{each.variant.name}, common::counted(each.runs.size())};
    for (const Field& field : fields_of(each)) row.push_back({field.text, field.median});
    rows.push_back(std::move(row));
  }
  return common::table_html(all, rows);
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
              "process of its own, in turn. Median (least to most) over repetitions.") +
          (report.interrupted ? " The experiment was interrupted." : "") +
          (report.failure.empty() ? "" : " It ended early: " + report.failure + ".")) +
          table_of(report) + common::heading_html("Speed against time") +
          common::chart_html(speed) +
          common::heading_html("Share of the steps in specialised scenes") +
          common::chart_html(share) + common::heading_html("Command and machine") +
          common::facts_html(facts));
}

}  // namespace navjit::warmup
