#include "apps/scan/report.hpp"

#include <algorithm>
#include <cstdio>
#include <limits>

#include "common/gnuplot.hpp"
#include "common/text.hpp"

namespace navjit::scan {
namespace {

using common::literal;
using common::quoted;

/// Materials that the plot names; the others are one.
constexpr std::size_t named = 9;
constexpr const char* colours[named + 1] = {"#4477aa", "#ee8866", "#44bb99", "#ddcc77", "#aa4499",
                                            "#88ccee", "#999933", "#cc6677", "#bbcc33", "#bbbbbb"};

/// "eta_low eta_high" as a curve of steps: two points for each bin.
std::string steps_of(const Scan& scan, const std::vector<double>& low,
                     const std::vector<double>& high) {
  std::string lines;
  for (int i = 0; i < scan.request.eta_bins; ++i) {
    const auto at = static_cast<std::size_t>(i);
    for (const int side : {0, 1}) {
      lines += literal(scan.eta_edge(i + side)) + ' ' + literal(low[at]) + ' ' + literal(high[at]) +
               '\n';
    }
  }
  return lines;
}

std::string stack_of(const Scan& scan, const std::vector<Part>& parts, std::string& data) {
  const auto bins = static_cast<std::size_t>(scan.request.eta_bins);
  std::vector<double> low(bins), high(bins);
  std::string plots;
  const auto add = [&](const std::string& name, std::size_t number) {
    const std::string block = "$m" + std::to_string(number);
    data += block + " << EOD\n" + steps_of(scan, low, high) + "EOD\n";
    plots += (plots.empty() ? "plot " : ", ") + block +
             " using 1:2:3 with filledcurves fs solid 0.85 noborder lc rgb '" + colours[number] +
             "' title " + quoted(common::printable(name)) + " noenhanced";
    low = high;
  };
  for (std::size_t k = 0; k < parts.size(); ++k) {
    for (std::size_t i = 0; i < bins; ++i) high[i] += parts[k].by_eta[i];
    const bool last = k + 1 == parts.size();
    if (k < named)
      add(parts[k].material, k);
    else if (last)
      add("(" + std::to_string(parts.size() - named) + " others)", named);
  }
  if (plots.empty()) {
    data += "$m0 << EOD\n" + steps_of(scan, low, high) + "EOD\n";
    plots = "plot $m0 using 1:3 with lines title ''";
  }
  return plots;
}

std::string map_of(const Scan& scan, Quantity quantity) {
  std::string lines;
  // Corners of bins, as gnuplot's pm3d has them: a value belongs to the cell that begins there.
  for (int i = 0; i <= scan.request.eta_bins; ++i) {
    for (int j = 0; j <= scan.request.phi_bins; ++j) {
      const double value = value_of(
          scan.bin(std::min(i, scan.request.eta_bins - 1), std::min(j, scan.request.phi_bins - 1)),
          quantity);
      lines +=
          literal(scan.eta_edge(i)) + ' ' + literal(scan.phi_edge(j)) + ' ' + literal(value) + '\n';
    }
    lines += '\n';
  }
  return lines;
}

}  // namespace

std::string table_text(const Scan& scan, const World& world, Quantity quantity) {
  const std::vector<Part> parts = parts_of(scan, world, quantity);
  std::string text = "         eta         X0    g/cm2   lambda       mm   " +
                     std::string("least    most  most of it in\n");
  for (int i = 0; i < scan.request.eta_bins; ++i) {
    const Budget mean = scan.mean(i);
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (int j = 0; j < scan.request.phi_bins; ++j) {
      const double value = value_of(scan.bin(i, j), quantity);
      least = std::min(least, value);
      most = std::max(most, value);
    }
    char row[160];
    std::snprintf(row, sizeof row, "%6.3f %6.3f %9.4g %8.4g %8.4g %8.5g %7.3g %7.3g  ",
                  scan.eta_edge(i), scan.eta_edge(i + 1), mean.radiation_lengths, mean.mass,
                  mean.interaction_lengths, mean.path, least, most);
    text += row;
    const auto bin = static_cast<std::size_t>(i);
    const auto first = std::max_element(
        parts.begin(), parts.end(),
        [&](const Part& a, const Part& b) { return a.by_eta[bin] < b.by_eta[bin]; });
    const double all = value_of(mean, quantity);
    if (first != parts.end() && all > 0) {
      std::snprintf(row, sizeof row, " %.0f%%", 100 * first->by_eta[bin] / all);
      text += common::printable(first->material) + row;
    }
    text += '\n';
  }
  return text;
}

std::string csv_text(const Scan& scan) {
  std::string text = "eta_low,eta_high,phi_low,phi_high,rays,x0,g_cm2,lambda,path_mm\n";
  const int rays = scan.request.rays * scan.request.rays;
  for (int i = 0; i < scan.request.eta_bins; ++i) {
    for (int j = 0; j < scan.request.phi_bins; ++j) {
      const Budget& bin = scan.bin(i, j);
      char row[256];
      std::snprintf(row, sizeof row, "%.9g,%.9g,%.9g,%.9g,%d,%.9g,%.9g,%.9g,%.9g\n",
                    scan.eta_edge(i), scan.eta_edge(i + 1), scan.phi_edge(j), scan.phi_edge(j + 1),
                    rays, bin.radiation_lengths, bin.mass, bin.interaction_lengths, bin.path);
      text += row;
    }
  }
  return text;
}

std::string draw(const Scan& scan, const World& world, Quantity quantity, const std::string& title,
                 const std::string& file) {
  std::string data;
  const std::string stack = stack_of(scan, parts_of(scan, world, quantity), data);
  data += "$map << EOD\n" + map_of(scan, quantity) + "EOD\n";
  const std::string eta =
      "[" + literal(scan.request.eta.low) + ":" + literal(scan.request.eta.high) + "]";
  // Both plots are of the same width, so that one eta is below the other; the legend is beside.
  return common::plot(
      data + "set multiplot title " + quoted(common::printable(title)) +
          " noenhanced\nset lmargin at screen 0.09\nset rmargin at screen 0.72\nset xrange " + eta +
          "\nset tmargin at screen 0.92\nset bmargin at screen 0.56\nset yrange [0:*]\n" +
          "set ylabel " + quoted(std::string(unit_of(quantity)) + ", mean") +
          "\nset key at screen 0.74,0.92 left top reverse Left invert\nset grid\n" + stack +
          "\nunset key\nset tmargin at screen 0.48\nset bmargin at screen 0.11\n" +
          "set xlabel 'pseudorapidity'\nset ylabel 'azimuth, rad'\nset yrange [" +
          literal(scan.request.phi.low) + ":" + literal(scan.request.phi.high) + "]\n" +
          "set pm3d map corners2color c1\nset cblabel " + quoted(unit_of(quantity)) +
          "\nset colorbox user origin 0.76,0.11 size 0.03,0.37\nunset grid\n" +
          "set palette defined (0 '#201040', 1 '#323880', 2 '#2c688e', 3 '#20948c', 4 '#40ba74', " +
          "5 '#98d840', 6 '#fce830')\nset cbrange [0:*]\nsplot $map using 1:2:3\nunset multiplot",
      file);
}

}  // namespace navjit::scan
