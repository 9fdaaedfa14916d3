#include "apps/warmup/picture.hpp"

#include <algorithm>

#include "common/gnuplot.hpp"
#include "navjit/errors.hpp"

namespace navjit::warmup {
namespace {

constexpr int bins = 80;

/// Lines "time rate share", medians over the repetitions; empty if there is nothing to draw.
std::string lines_of(const VariantReport& each, double end) {
  std::string lines;
  for (int i = 0; i < bins; ++i) {
    const double from = end * i / bins, to = end * (i + 1) / bins;
    std::vector<double> rates, shares;
    for (const RunFigures& run : each.runs) {
      rates.push_back(rate(run.record.series, from, to) / 1e6);
      shares.push_back(100 * share_at(run.record.swaps, to));
    }
    lines += common::literal((from + to) / 2) + ' ' + common::literal(spread(rates).median) + ' ' +
             common::literal(spread(shares).median) + '\n';
  }
  return lines;
}

}  // namespace

std::string draw(const ExperimentReport& report, const std::string& title,
                 const std::string& file) {
  double end = 0;
  for (const VariantReport& each : report.variants) {
    for (const RunFigures& run : each.runs) {
      const double last = run.record.series.empty() ? 0 : run.record.series.back().seconds;
      end = end == 0 ? last : std::min(end, last);
    }
  }
  if (end == 0) throw Error(file + ": nothing was measured that could be drawn");
  std::string data, rates, shares;
  for (std::size_t i = 0; i < report.variants.size(); ++i) {
    const VariantReport& each = report.variants[i];
    if (each.runs.empty()) continue;  // a signal came before
    const std::string block = "$v" + std::to_string(i);
    data += block + " << EOD\n" + lines_of(each, end) + "EOD\n";
    const std::string look = " with lines lw 2 lc " + std::to_string(i + 1) + " title " +
                             common::quoted(each.variant.name) + " noenhanced";
    const auto plot = [&](std::string& commands, const char* columns) {
      commands += commands.empty() ? "plot " : ", ";
      commands += block;
      commands += columns;
      commands += look;
    };
    plot(rates, " using 1:2");
    if (each.variant.mode == Mode::off) continue;
    plot(shares, " using 1:3");
  }
  std::string script = data + "set grid\nset xrange [0:" + common::literal(end) + "]\n";
  script += "set multiplot layout " + std::string(shares.empty() ? "1,1" : "2,1") + " title " +
            common::quoted(title) + " noenhanced\n";
  script +=
      "set lmargin 9\nset rmargin 16\nset key outside right top\nset yrange [0:*]\nset ylabel "
      "'million steps a second'\n" +
      rates;
  if (!shares.empty()) {
    script +=
        "\nset xlabel 'seconds since the start'\nset yrange [0:100]\n"
        "set ylabel 'steps specialised, %'\n" +
        shares;
  }
  return common::plot(script + "\nunset multiplot", file);
}

}  // namespace navjit::warmup
