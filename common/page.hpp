// Pages of HTML that need nothing but themselves: tables that sort, charts, pictures. They are
// readable by light and in the dark, on paper, and without scripts.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace navjit::common {

// All texts may hold names from files: they are escaped here.

/// What is in a table: a text, and the number to sort by where it is one.
struct Cell {
  std::string text;
  std::optional<double> value{};
};
/// "12.3" by a printf format, to be sorted by its value; a dash for what was not measured (0 or
/// less, or no number).
Cell measured(double value, const char* format);
/// "12,345".
Cell counted(std::uint64_t value);

/// A table that a click on a heading sorts. Rows have a cell for each heading.
std::string table_html(const std::vector<std::string>& headings,
                       const std::vector<std::vector<Cell>>& rows);

/// Two columns: what, and its value.
std::string facts_html(const std::vector<std::pair<std::string, std::string>>& facts);

struct ChartLine {
  std::string name;
  std::vector<std::pair<double, double>> points;  ///< from left to right
};
/// Something that happened.
struct ChartMark {
  double at;         ///< on the x axis
  double weight;     ///< 0 to 1: how high its line is
  std::string what;  ///< shown under the pointer
};
/// Linear axes begin at 0; on logarithmic ones, of whole decades, what is 0 or less is left out.
enum class Scale : std::uint8_t { linear, logarithmic };
struct Chart {
  std::string x_label, y_label;  ///< with units
  std::vector<ChartLine> lines;
  std::vector<ChartMark> marks{};
  std::string mark_name{};  ///< for the legend
  Scale x_scale = Scale::linear, y_scale = Scale::linear;
  bool dots = false;  ///< at each point of the lines
};
/// An <svg> element with its legend above it. A sentence where there is nothing to draw.
std::string chart_html(const Chart& chart);

/// Shares of a whole as one bar with a legend; they should add up to 1.
std::string shares_html(const std::vector<std::pair<std::string, double>>& shares);

/// A PNG picture with a line below it.
std::string picture_html(const std::string& png, const std::string& caption);

/// <h2> and <p>.
std::string heading_html(const std::string& text);
std::string paragraph_html(const std::string& text);

/// The whole page.
std::string page_html(const std::string& title, const std::string& body);

}  // namespace navjit::common
