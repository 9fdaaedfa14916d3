// A picture as it is handed out: views side by side, and what their colours mean.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/picture/colours.hpp"
#include "apps/picture/image.hpp"

namespace navjit::picture {

struct Panel {
  Image image;
  std::string title;  ///< empty: none
};

struct Entry {
  Rgb colour;
  std::string meaning;
};

struct Sheet {
  std::vector<Panel> panels;   ///< of the same size
  bool legend = true;          ///< without it there are the panels alone
  std::vector<Entry> entries;  ///< most important first; what has no place is counted
  std::optional<Scale> scale;
  std::string unit;                ///< of the scale
  std::vector<std::string> notes;  ///< lines below
};

/// Names from files may be in any text. Pixels of the panels are as they are.
std::string png_sheet(const Sheet& sheet);
/// An SVG file with the panels as pixels and the text as text.
std::string svg_sheet(const Sheet& sheet);

}  // namespace navjit::picture
