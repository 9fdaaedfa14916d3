#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/markup.hpp"
#include "common/page.hpp"

namespace navjit::common {
namespace {

constexpr double width = 900, height = 300, left = 64, right = 12, top = 8, bottom = 44;

/// What an axis shows: from 0 to a round number or, if it is `tight`, to the largest value.
struct Axis {
  double high, step;

  Axis(double largest, int parts, bool tight) {
    if (!(largest > 0) || !std::isfinite(largest)) largest = 1;
    const double rough = largest / parts, decade = std::pow(10, std::floor(std::log10(rough)));
    step = rough <= decade       ? decade
           : rough <= 2 * decade ? 2 * decade
           : rough <= 5 * decade ? 5 * decade
                                 : 10 * decade;
    high = tight ? largest : step * std::ceil(largest / step - 1e-9);
  }
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
  double largest_x = 0, largest_y = 0;
  std::size_t points = 0;
  for (const ChartLine& line : chart.lines) {
    for (const auto& [x, y] : line.points) {
      largest_x = std::max(largest_x, x);
      largest_y = std::max(largest_y, y);
    }
    points = std::max(points, line.points.size());
  }
  if (points < 2) return paragraph_html("The run was too short for a chart.");
  const Axis x_axis(largest_x, 8, true), y_axis(largest_y, 5, false);
  const auto x_of = [&](double x) { return left + x / x_axis.high * (width - left - right); };
  const auto y_of = [&](double y) {
    return height - bottom - y / y_axis.high * (height - top - bottom);
  };

  std::string svg = legend_of(chart) + "<svg viewBox=\"0 0 " + number(width, "%.0f") + " " +
                    number(height, "%.0f") + "\" role=\"img\" aria-label=\"" +
                    markup(chart.y_label) + "\">\n";
  for (int i = 0; i * y_axis.step <= y_axis.high * (1 + 1e-9); ++i) {
    const double y = y_of(i * y_axis.step);
    svg += grid_line(left, y, width - right, y) +
           text_at(left - 6, y + 4, "end", number(i * y_axis.step, "%.4g")) + "\n";
  }
  for (int i = 0; i * x_axis.step <= x_axis.high * (1 + 1e-9); ++i) {
    const double x = x_of(i * x_axis.step);
    svg += grid_line(x, height - bottom, x, height - bottom + 5) +
           text_at(x, height - bottom + 18, "middle", number(i * x_axis.step, "%.4g")) + "\n";
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
    svg += "<polyline class=\"k" + std::to_string(i % 6 + 1) +
           "\" fill=\"none\" stroke-width=\"2\" points=\"";
    for (const auto& [x, y] : chart.lines[i].points)
      svg += number(x_of(x)) + "," + number(y_of(y)) + " ";
    svg += "\"/>\n";
  }
  svg += text_at((left + width - right) / 2, height - 6, "middle", chart.x_label) +
         text_at(14, (top + height - bottom) / 2, "middle", chart.y_label,
                 " transform=\"rotate(-90 14 " + number((top + height - bottom) / 2) + ")\"");
  return svg + "\n</svg>\n";
}

}  // namespace navjit::common
