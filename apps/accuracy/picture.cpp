#include "apps/accuracy/picture.hpp"

#include <algorithm>
#include <cmath>

#include "common/gnuplot.hpp"
#include "navjit/errors.hpp"

namespace navjit::accuracy {
namespace {

/// Errors are drawn on a logarithmic scale, which knows no zero: a hundredth of an ulp stands for
/// it.
constexpr double least = 0.01;

bool has_figures(const EngineReport& engine) {
  return engine.ns_per_step > 0 && !engine.figures.all.errors.along_ulp.empty();
}

}  // namespace

bool can_be_drawn(const ExperimentReport& report) {
  return std::any_of(report.engines.begin(), report.engines.end(), has_figures);
}

std::string draw(const ExperimentReport& report, const std::string& title,
                 const std::string& file) {
  std::string data, plots;
  double slowest = 0;
  for (const EngineReport& engine : report.engines) {
    if (!has_figures(engine)) continue;
    const Quantiles q = quantiles(engine.figures.all.errors.along_ulp);
    const std::string block = "$e" + std::to_string(plots.size());
    data += block + " << EOD\n" + common::literal(engine.ns_per_step) + ' ' +
            common::literal(std::max(q.high, least)) + ' ' +
            common::literal(std::max(q.median, least)) + ' ' +
            common::literal(std::max(q.largest, least)) + "\nEOD\n";
    plots += (plots.empty() ? "plot " : ", ") + block +
             " using 1:2:3:4 with yerrorbars lw 2 pt 7 ps 1.5 title " + common::quoted(engine.name);
    slowest = std::max(slowest, engine.ns_per_step);
  }
  if (plots.empty()) throw Error(file + ": nothing was measured that could be drawn");
  return common::plot(
      "set title " + common::quoted(title) + " noenhanced\nset xlabel 'ns a step'\n" +
          "set ylabel 'error of the length, ulp of the coordinates: median, 99.9%, largest'\n" +
          "set logscale y\nset format y '10^{%L}'\nset xrange [0:" +
          common::literal(1.15 * slowest) + "]\nset grid\nset key outside right top\n" + data +
          plots,
      file);
}

}  // namespace navjit::accuracy
