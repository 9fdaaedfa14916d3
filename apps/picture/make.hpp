// From what is asked for to a picture.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/picture/colours.hpp"
#include "apps/picture/render.hpp"
#include "apps/picture/sheet.hpp"
#include "apps/picture/view.hpp"
#include "apps/picture/visible.hpp"
#include "navjit/options.hpp"

namespace navjit::picture {

/// Pixels along a side, at the most.
constexpr std::uint64_t most_pixels = 8192;

enum class Mode : std::uint8_t { surface, path, radiation_lengths, mass, steps, time };

struct Request {
  Mode mode = Mode::surface;
  ColourBy colour = ColourBy::volume;
  ViewOptions view{};
  ShowOptions show{};
  Frame frame{};  ///< but for its view
  /// Seen from the side that the half-space is on.
  std::optional<HalfSpace> slice{};
  bool flat = false, logarithmic = false, legend = true;
  RuntimeOptions runtime{};
};

struct Made {
  Sheet sheet;
  std::vector<double> shares;      ///< of the pixels, for each entry of the sheet
  std::vector<std::string> lines;  ///< what else there is to say
  int width = 0, height = 0;       ///< of a panel
};

/// Rows that frame.progress will be told of.
int rows_of(const Request& request);

/// Throws UsageError and Error for a view or a name that is not to be had.
Made make(const std::shared_ptr<const World>& world, const Request& request);

}  // namespace navjit::picture
