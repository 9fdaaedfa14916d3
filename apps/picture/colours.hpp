// Which colour stands for what.
#pragma once

#include <span>
#include <string>

#include "apps/picture/image.hpp"
#include "apps/picture/render.hpp"
#include "geometry/model/world.hpp"

namespace navjit::picture {

constexpr Rgb background{255, 255, 255};
constexpr Rgb stuck_colour{255, 0, 255};

/// What the colours of surfaces tell.
enum class ColourBy : std::uint8_t { volume, material, density };

/// The same in every picture of the detector.
Rgb colour_of(const World& world, VolumeId volume, ColourBy by);
/// What the colour stands for: the volume's name, the material's, or "7.87 g/cm3".
std::string meaning_of(const World& world, VolumeId volume, ColourBy by);

/// Surfaces in colours. Shaded: by their light, with darker lines where one touchable ends and
/// another begins, and gases pale; else each pixel has the colour of its volume alone.
Image paint(const World& world, const std::vector<Surface>& surfaces, int width, int height,
            ColourBy by, bool shaded);

/// Colours for numbers.
enum class ColourMap : std::uint8_t { cool, hot };
struct Scale {
  double low = 0, high = 1;
  bool logarithmic = false;
  ColourMap map = ColourMap::cool;

  /// From 0 (low or less) to 1 (high or more).
  double position(double value) const;
  Rgb colour(double value) const;  ///< stuck_colour for what is no number
  /// Round numbers from low to high.
  std::vector<double> marks() const;
};

/// From 0, or four decades for a logarithmic one, to a round number that one value of 500 exceeds.
Scale scale_of(std::span<const double> values, bool logarithmic, ColourMap map);

Image paint(const std::vector<double>& values, int width, int height, const Scale& scale);

}  // namespace navjit::picture
