#include "apps/picture/sheet.hpp"

#include <algorithm>
#include <cstdio>
#include <string_view>

#include "apps/picture/font.hpp"
#include "common/markup.hpp"
#include "common/text.hpp"

namespace navjit::picture {
namespace {

constexpr std::size_t longest_meaning = 26;
constexpr Rgb ink{32, 32, 32};

/// Both kinds of files are laid out alike; numbers are pixels.
struct Layout {
  int factor, line;  ///< of letters; height of a line
  int gap;           ///< between the parts
  int head;          ///< above the panels
  int panel_width, panel_height;
  int legend_x, legend_width;
  int width, height;
};

/// Without the address that Geant4 appends to names: it says nothing, and takes room.
std::string_view without_address(std::string_view name) {
  const std::size_t digits = name.find_last_not_of("0123456789abcdef");
  const bool address = digits != std::string_view::npos && digits > 1 && name[digits] == 'x' &&
                       name[digits - 1] == '0' && name.size() - digits > 6;
  return address ? name.substr(0, digits - 1) : name;
}

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

Layout layout_of(const Sheet& sheet) {
  const Image& first = sheet.panels.front().image;
  Layout l{};
  l.panel_width = first.width;
  l.panel_height = first.height;
  l.factor = std::clamp(first.height / 300, 1, 6);
  l.line = l.factor * (letter_height + 2);
  l.gap = sheet.legend ? 6 * l.factor : 0;
  const bool titled = std::any_of(sheet.panels.begin(), sheet.panels.end(),
                                  [](const Panel& panel) { return !panel.title.empty(); });
  l.head = sheet.legend && titled ? l.line + l.gap : 0;
  const int panels = static_cast<int>(sheet.panels.size());
  l.legend_x = panels * (l.panel_width + l.gap) + l.gap;
  std::size_t letters = sheet.scale ? std::max<std::size_t>(12, sheet.unit.size()) : 0;
  for (const Entry& entry : sheet.entries) {
    letters = std::max(letters, std::min(entry.meaning.size(), longest_meaning) + 3);
  }
  for (const std::string& note : sheet.notes) letters = std::max(letters, note.size());
  l.legend_width = sheet.legend ? static_cast<int>(letters) * letter_width * l.factor + l.gap : 0;
  l.width = sheet.legend ? l.legend_x + l.legend_width : panels * l.panel_width;
  // A picture of a few pixels still has room for a line.
  l.height = sheet.legend ? std::max(l.head + l.panel_height, 3 * l.line) : l.panel_height;
  return l;
}

/// Draws the parts of a legend where they belong: `text(x, y, words)` with y at the top of a line,
/// `box(x, y, width, height, colour)`.
template <class Text, class Box>
void draw_legend(const Sheet& sheet, const Layout& l, Text&& text, Box&& box) {
  int y = l.head > 0 ? l.head : l.factor;
  const int notes = static_cast<int>(sheet.notes.size());
  const int room = l.height - l.head - notes * l.line;
  if (sheet.scale) {
    text(l.legend_x, y, sheet.unit);
    y += l.line + l.gap;
    const int height = std::max(room - l.line - 3 * l.gap, 1), width = 2 * l.line;
    for (int row = 0; row < height; ++row) {
      const double part = 1 - (row + 0.5) / height;
      const Scale& scale = *sheet.scale;
      const Scale plain{0, 1, false, scale.map};
      box(l.legend_x, y + row, width, 1, plain.colour(part));
    }
    for (const double mark : sheet.scale->marks()) {
      const int at = y + static_cast<int>((1 - sheet.scale->position(mark)) * (height - 1));
      box(l.legend_x + width, at, l.gap, l.factor, ink);
      text(l.legend_x + width + 2 * l.gap, at - 3 * l.factor, number_text(mark));
    }
  }
  std::size_t shown = sheet.entries.size();
  const auto places = static_cast<std::size_t>(std::max(room / l.line, 0));
  if (shown > places) shown = places > 0 ? places - 1 : 0;
  for (std::size_t i = 0; i < shown; ++i, y += l.line) {
    box(l.legend_x, y, 7 * l.factor, 7 * l.factor, sheet.entries[i].colour);
    const std::string meaning = common::printable(without_address(sheet.entries[i].meaning));
    text(l.legend_x + 2 * letter_width * l.factor, y,
         meaning.size() <= longest_meaning ? meaning : common::fitted(meaning, longest_meaning));
  }
  if (shown < sheet.entries.size()) {
    text(l.legend_x, y, "(" + std::to_string(sheet.entries.size() - shown) + " more)");
  }
  y = l.height - notes * l.line;
  for (const std::string& note : sheet.notes) {
    text(l.legend_x, y, note);
    y += l.line;
  }
}

int panel_x(const Sheet& sheet, const Layout& l, std::size_t number) {
  return static_cast<int>(number) * (l.panel_width + (sheet.legend ? l.gap : 0));
}

std::string hexadecimal(Rgb colour) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", colour.red, colour.green, colour.blue);
  return text;
}

}  // namespace

std::string png_sheet(const Sheet& sheet) {
  const Layout l = layout_of(sheet);
  if (!sheet.legend && sheet.panels.size() == 1) return png_of(sheet.panels.front().image);
  Image image(l.width, l.height, background);
  const auto text = [&](int x, int y, const std::string& words) {
    draw_text(image, x, y + l.factor, l.factor, ink, words);
  };
  for (std::size_t i = 0; i < sheet.panels.size(); ++i) {
    const Image& panel = sheet.panels[i].image;
    const int left = panel_x(sheet, l, i);
    for (int y = 0; y < panel.height; ++y) {
      for (int x = 0; x < panel.width; ++x) image.at(left + x, l.head + y) = panel.at(x, y);
    }
    if (l.head > 0) text(left + l.gap, l.gap / 2, sheet.panels[i].title);
  }
  if (sheet.legend) {
    draw_legend(sheet, l, text, [&](int x, int y, int width, int height, Rgb colour) {
      fill(image, x, y, width, height, colour);
    });
  }
  return png_of(image);
}

std::string svg_sheet(const Sheet& sheet) {
  const Layout l = layout_of(sheet);
  const auto number = [](int value) { return '"' + std::to_string(value) + '"'; };
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=" + number(l.width) +
                    " height=" + number(l.height) + " viewBox=\"0 0 " + std::to_string(l.width) +
                    ' ' + std::to_string(l.height) +
                    "\" font-family=\"monospace\" font-size=" + number(l.factor * letter_height) +
                    ">\n<rect width=\"100%\" height=\"100%\" " + "fill=\"#ffffff\"/>\n";
  const auto text = [&](int x, int y, const std::string& words) {
    svg += "<text x=" + number(x) + " y=" + number(y + 8 * l.factor) + " fill=\"" +
           hexadecimal(ink) + "\">" + common::markup(words) + "</text>\n";
  };
  for (std::size_t i = 0; i < sheet.panels.size(); ++i) {
    const int left = panel_x(sheet, l, i);
    svg += "<image x=" + number(left) + " y=" + number(l.head) + " width=" + number(l.panel_width) +
           " height=" + number(l.panel_height) + " href=\"data:image/png;base64," +
           common::base64(png_of(sheet.panels[i].image)) + "\"/>\n";
    if (l.head > 0) text(left + l.gap, l.gap / 2, sheet.panels[i].title);
  }
  if (sheet.legend) {
    draw_legend(sheet, l, text, [&](int x, int y, int width, int height, Rgb colour) {
      svg += "<rect x=" + number(x) + " y=" + number(y) + " width=" + number(width) +
             " height=" + number(height) + " fill=\"" + hexadecimal(colour) + "\"/>\n";
    });
  }
  return svg + "</svg>\n";
}

}  // namespace navjit::picture
