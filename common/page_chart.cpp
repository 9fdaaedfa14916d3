#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/markup.hpp"
#include "common/page.hpp"

namespace navjit::common {
namespace {

constexpr double width = 900, height = 300, left = 64, right = 12, top = 8, bottom = 44;

/// What an axis shows, in the lengths along it: for a logarithmic one decades.
struct Axis {
  Scale scale;
  double low = 0, high = 1, step = 1;

  /// Linear: from 0 to a round number or, if it is `tight`, to the largest value.
  Axis(Scale of, double smallest, double largest, int parts, bool tight) : scale(of) {
    if (scale == Scale::logarithmic) {
      low = std::floor(along(smallest) + 1e-9);
      high = std::max(low + 1, std::ceil(along(largest) - 1e-9));
      step = std::ceil((high - low) / parts);
      return;
    }
    if (!(largest > 0) || !std::isfinite(largest)) largest = 1;
    const double rough = largest / parts, decade = std::pow(10, std::floor(std::log10(rough)));
    step = rough <= decade       ? decade
           : rough <= 2 * decade ? 2 * decade
           : rough <= 5 * decade ? 5 * decade
                                 : 10 * decade;
    high = tight ? largest : step * std::ceil(largest / step - 1e-9);
  }
  bool shows(double value) const { return scale == Scale::linear || value > 0; }
  double along(double value) const { return scale == Scale::linear ? value : std::log10(value); }
  /// Where a value is, as a share of the axis' length.
  double part(double value) const { return (along(value) - low) / (high - low); }
  double value(double at) const { return scale == Scale::linear ? at : std::pow(10, at); }
};

std::string number(double value, const char* format = "%.1f") {
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string text_at(double x, double y, const char* anchor, const std::string& words,
                    const std::string& more = "") {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + anchor + "\"" +
         more + ">" + markup(words) + "</text>";
}

std::string grid_line(double x1, double y1, double x2, double y2) {
  return "<line class=\"grid\" x1=\"" + number(x1) + "\" y1=\"" + number(y1) + "\" x2=\"" +
         number(x2) + "\" y2=\"" + number(y2) + "\"/>";
}

std::string legend_of(const Chart& chart) {
  std::string html = "<p class=\"legend\">";
  for (std::size_t i = 0; i < chart.lines.size(); ++i) {
    html += "<span class=\"key\"><i class=\"k" + std::to_string(i % 6 + 1) + "\"></i>" +
            markup(chart.lines[i].name) + "</span> ";
  }
  if (!chart.marks.empty() && !chart.mark_name.empty()) {
    html += "<span class=\"key\"><i class=\"mark\"></i>" + markup(chart.mark_name) + "</span>";
  }
  return html + "</p>\n";
}

}  // namespace

std::string chart_html(const Chart& chart) {
  // What an axis without values shows.
  double smallest_x = 1, largest_x = 0, smallest_y = 1, largest_y = 0;
  std::size_t points = 0;
  for (const ChartLine& line : chart.lines) {
    for (const auto& [x, y] : line.points) {
      largest_x = std::max(largest_x, x);
      largest_y = std::max(largest_y, y);
      if (x > 0) smallest_x = std::min(smallest_x, x);
      if (y > 0) smallest_y = std::min(smallest_y, y);
    }
    points = std::max(points, line.points.size());
  }
  if (points < 2) return paragraph_html("The run was too short for a chart.");
  const Axis x_axis(chart.x_scale, smallest_x, largest_x, 8, !chart.dots),
      y_axis(chart.y_scale, smallest_y, largest_y, 5, false);
  const auto x_of = [&](double x) { return left + x_axis.part(x) * (width - left - right); };
  const auto y_of = [&](double y) {
    return height - bottom - y_axis.part(y) * (height - top - bottom);
  };

  std::string svg = legend_of(chart) + "<svg viewBox=\"0 0 " + number(width, "%.0f") + " " +
                    number(height, "%.0f") + "\" role=\"img\" aria-label=\"" +
                    markup(chart.y_label) + "\">\n";
  for (int i = 0; y_axis.low + i * y_axis.step <= y_axis.high + 1e-9 * y_axis.step; ++i) {
    const double value = y_axis.value(y_axis.low + i * y_axis.step), y = y_of(value);
    svg += grid_line(left, y, width - right, y) +
           text_at(left - 6, y + 4, "end", number(value, "%.4g")) + "\n";
  }
  for (int i = 0; x_axis.low + i * x_axis.step <= x_axis.high + 1e-9 * x_axis.step; ++i) {
    const double value = x_axis.value(x_axis.low + i * x_axis.step), x = x_of(value);
    svg += grid_line(x, height - bottom, x, height - bottom + 5) +
           text_at(x, height - bottom + 18, "middle", number(value, "%.4g")) + "\n";
  }
  for (const ChartMark& mark : chart.marks) {
    const double x = x_of(std::clamp(mark.at, 0.0, x_axis.high));
    // Even what hardly counts is seen.
    const double length =
        (0.06 + 0.94 * std::clamp(mark.weight, 0.0, 1.0)) * (height - top - bottom);
    svg += "<g><title>" + markup(mark.what) + "</title><line class=\"mark\" x1=\"" + number(x) +
           "\" x2=\"" + number(x) + "\" y1=\"" + number(height - bottom) + "\" y2=\"" +
           number(height - bottom - length) + "\"/></g>\n";
  }
  for (std::size_t i = 0; i < chart.lines.size(); ++i) {
    const std::string colour = "k" + std::to_string(i % 6 + 1);
    std::string line, dots;
    for (const auto& [x, y] : chart.lines[i].points) {
      if (!x_axis.shows(x) || !y_axis.shows(y)) continue;
      line += number(x_of(x)) + "," + number(y_of(y)) + " ";
      if (!chart.dots) continue;
      dots += "<circle class=\"" + colour + "\" cx=\"" + number(x_of(x)) + "\" cy=\"" +
              number(y_of(y)) + "\" r=\"4\"/>";
    }
    svg += "<polyline class=\"" + colour + "\" fill=\"none\" stroke-width=\"2\" points=\"" + line +
           "\"/>" + dots + "\n";
  }
  svg += text_at((left + width - right) / 2, height - 6, "middle", chart.x_label) +
         text_at(14, (top + height - bottom) / 2, "middle", chart.y_label,
                 " transform=\"rotate(-90 14 " + number((top + height - bottom) / 2) + ")\"");
  return svg + "\n</svg>\n";
}

}  // namespace navjit::common
