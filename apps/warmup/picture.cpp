#include "apps/warmup/picture.hpp"

#include <algorithm>

#include "common/gnuplot.hpp"
#include "navjit/errors.hpp"

namespace navjit::warmup {
namespace {

constexpr int bins = 80;

}  // namespace

std::vector<Curve> curves_of(const ExperimentReport& report) {
  double end = 0;
  for (const VariantReport& each : report.variants) {
    for (const RunFigures& run : each.runs) {
      const double last = run.record.series.empty() ? 0 : run.record.series.back().seconds;
      end = end == 0 ? last : std::min(end, last);
    }
  }
  std::vector<Curve> curves;
  if (end == 0) return curves;
  for (const VariantReport& each : report.variants) {
    if (each.runs.empty()) continue;  // a signal came before
    Curve curve{each.variant, {}};
    for (int i = 0; i < bins; ++i) {
      const double from = end * i / bins, to = end * (i + 1) / bins;
      std::vector<double> rates, shares;
      for (const RunFigures& run : each.runs) {
        rates.push_back(rate(run.record.series, from, to) / 1e6);
        shares.push_back(100 * share_at(run.record.swaps, to));
      }
      curve.moments.push_back({(from + to) / 2, spread(rates).median, spread(shares).median});
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

std::string draw(const ExperimentReport& report, const std::string& title,
                 const std::string& file) {
  const std::vector<Curve> curves = curves_of(report);
  if (curves.empty()) throw Error(file + ": nothing was measured that could be drawn");
  const Curve::Moment& last = curves.front().moments.back();
  const double end = last.seconds * 2 * bins / (2 * bins - 1);
  std::string data, rates, shares;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const Curve& each = curves[i];
    const std::string block = "$v" + std::to_string(i);
    data += block + " << EOD\n";
    for (const Curve::Moment& at : each.moments) {
      data += common::literal(at.seconds) + ' ' + common::literal(at.million_steps_per_second) +
              ' ' + common::literal(at.percent_specialised) + '\n';
    }
    data += "EOD\n";
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
