#include "apps/picture/colours.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

namespace navjit::picture {
namespace {

std::uint8_t byte_of(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

Rgb scaled(Rgb colour, double factor) {
  return {byte_of(factor * colour.red), byte_of(factor * colour.green),
          byte_of(factor * colour.blue)};
}

/// Numbers near one another give hues far apart: by the golden ratio.
Rgb colour_of_number(std::uint32_t number) {
  constexpr double saturations[] = {0.50, 0.72, 0.36}, values[] = {0.93, 0.80, 0.98};
  const double hue = 6 * std::fmod(0.58 + 0.6180339887498949 * number, 1.0);
  const double saturation = saturations[number % 3], value = 255 * values[number % 3];
  const auto channel = [&](double shift) {
    const double k = std::fmod(hue + shift, 6.0);
    return byte_of(value * (1 - saturation * std::clamp(std::min(k, 4 - k), 0.0, 1.0)));
  };
  return {channel(5), channel(3), channel(1)};
}

Rgb between(std::span<const Rgb> stops, double position) {
  const double at = std::clamp(position, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
  const std::size_t low = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  const double part = at - static_cast<double>(low);
  const Rgb a = stops[low], b = stops[low + 1];
  return {byte_of(a.red + part * (b.red - a.red)), byte_of(a.green + part * (b.green - a.green)),
          byte_of(a.blue + part * (b.blue - a.blue))};
}

/// Both grow lighter all the way, so that they are read without colours, too.
constexpr Rgb cool_stops[] = {{32, 16, 64},   {50, 56, 128},  {44, 104, 142}, {32, 148, 140},
                              {64, 186, 116}, {152, 216, 64}, {252, 232, 48}};
constexpr Rgb hot_stops[] = {{8, 6, 24},     {64, 16, 96},   {132, 32, 108}, {196, 56, 76},
                             {240, 108, 32}, {252, 176, 28}, {252, 248, 168}};

const Scale densities{0.02, 20, true, ColourMap::cool};

double density_of(const World& world, VolumeId volume) {
  const std::uint32_t material = world.volumes[volume].material;
  return material < world.materials.size() ? world.materials[material].density : 0;
}

/// 1, 2 or 5 times a power of ten: the least that is no less.
double round_up(double value) {
  if (!(value > 0) || !std::isfinite(value)) return 1;
  const double decade = std::pow(10, std::floor(std::log10(value)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * decade >= value * (1 - 1e-9)) return factor * decade;
  }
  return 10 * decade;
}

/// Whether one touchable ends beside this pixel.
bool at_edge(const std::vector<Surface>& surfaces, int width, int height, int x, int y) {
  const auto at = [&](int i, int j) {
    const Surface& s = surfaces[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) +
                                static_cast<std::size_t>(i)];
    return std::pair(s.volume, s.touchable);
  };
  return (x + 1 < width && at(x, y) != at(x + 1, y)) ||
         (y + 1 < height && at(x, y) != at(x, y + 1));
}

}  // namespace

Rgb colour_of(const World& world, VolumeId volume, ColourBy by) {
  switch (by) {
    case ColourBy::volume:
      return colour_of_number(volume);
    case ColourBy::material:
      return colour_of_number(world.volumes[volume].material);
    case ColourBy::density:
      return densities.colour(density_of(world, volume));
  }
  return {};
}

std::string meaning_of(const World& world, VolumeId volume, ColourBy by) {
  const LogicalVolume& of = world.volumes[volume];
  if (by == ColourBy::volume) return of.name;
  if (by == ColourBy::material) {
    return of.material < world.materials.size() ? world.materials[of.material].name
                                                : "(no material)";
  }
  char text[40];
  std::snprintf(text, sizeof text, "%.3g g/cm3", density_of(world, volume));
  return text;
}

Image paint(const World& world, const std::vector<Surface>& surfaces, int width, int height,
            ColourBy by, bool shaded) {
  // So few steps of light that the file stays small.
  constexpr double lights = 28;
  Image image(width, height, background);
  std::vector<Rgb> colours;
  for (VolumeId v = 0; v < world.volumes.size(); ++v) {
    const std::uint32_t material = world.volumes[v].material;
    const bool pale =
        shaded && (material >= world.materials.size() || is_transparent(world.materials[material]));
    const Rgb colour = colour_of(world, v, by);
    const Rgb stops[] = {colour, background};
    colours.push_back(pale ? between(stops, 0.7) : colour);
  }
  for (int y = 0, number = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x, ++number) {
      const Surface& surface = surfaces[static_cast<std::size_t>(number)];
      Rgb& pixel = image.at(x, y);
      if (surface.volume == Surface::stuck) {
        pixel = stuck_colour;
      } else if (surface.volume != Surface::nothing) {
        pixel = colours[surface.volume];
        if (!shaded) continue;
        const double edge = at_edge(surfaces, width, height, x, y) ? 0.72 : 1;
        pixel = scaled(pixel, edge * std::round(lights * surface.light) / lights);
      }
    }
  }
  return image;
}

double Scale::position(double value) const {
  if (!logarithmic) return std::clamp((value - low) / (high - low), 0.0, 1.0);
  if (!(value > low)) return 0;
  return std::min(std::log(value / low) / std::log(high / low), 1.0);
}

Rgb Scale::colour(double value) const {
  if (std::isnan(value)) return stuck_colour;
  const std::span<const Rgb> stops = map == ColourMap::hot ? hot_stops : cool_stops;
  // No more colours than a palette holds.
  return between(stops, std::round(200 * position(value)) / 200);
}

std::vector<double> Scale::marks() const {
  std::vector<double> marks;
  if (logarithmic) {
    for (double mark = low; mark <= high * 1.001; mark *= 10) marks.push_back(mark);
    return marks;
  }
  const double first = high / std::pow(10, std::floor(std::log10(high)));
  const int parts = std::abs(first - 2) < 1e-6 ? 4 : 5;
  for (int i = 0; i <= parts; ++i) marks.push_back(low + i * (high - low) / parts);
  return marks;
}

Scale scale_of(std::span<const double> values, bool logarithmic, ColourMap map) {
  std::vector<double> numbers;
  std::copy_if(values.begin(), values.end(), std::back_inserter(numbers),
               [](double value) { return std::isfinite(value); });
  Scale scale{0, 1, logarithmic, map};
  if (!numbers.empty()) {
    const auto most = numbers.begin() + static_cast<std::ptrdiff_t>((numbers.size() - 1) -
                                                                    (numbers.size() - 1) / 500);
    std::nth_element(numbers.begin(), most, numbers.end());
    double high = *most;
    if (!(high > 0)) high = *std::max_element(numbers.begin(), numbers.end());
    scale.high = round_up(high);
  }
  if (logarithmic) scale.low = scale.high / 1e4;
  return scale;
}

Image paint(const std::vector<double>& values, int width, int height, const Scale& scale) {
  Image image(width, height, background);
  std::transform(values.begin(), values.end(), image.pixels.begin(),
                 [&](double value) { return scale.colour(value); });
  return image;
}

}  // namespace navjit::picture
