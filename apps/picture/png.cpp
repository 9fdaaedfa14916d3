#include <png.h>

#include <cstring>
#include <map>
#include <optional>
#include <tuple>

#include "apps/picture/image.hpp"
#include "navjit/errors.hpp"

namespace navjit::picture {
namespace {

/// Pixels as numbers of colours.
struct Palette {
  std::vector<Rgb> colours;
  std::vector<std::uint8_t> pixels;
};

std::optional<Palette> palette_of(const Image& image) {
  constexpr std::size_t most = 256;
  Palette palette;
  palette.pixels.reserve(image.pixels.size());
  std::map<std::tuple<int, int, int>, std::uint8_t> numbers;
  for (const Rgb& pixel : image.pixels) {
    const std::tuple<int, int, int> key{pixel.red, pixel.green, pixel.blue};
    auto found = numbers.find(key);
    if (found == numbers.end()) {
      if (palette.colours.size() == most) return std::nullopt;
      found = numbers.emplace(key, static_cast<std::uint8_t>(palette.colours.size())).first;
      palette.colours.push_back(pixel);
    }
    palette.pixels.push_back(found->second);
  }
  return palette;
}

}  // namespace

std::string png_of(const Image& image) {
  static_assert(sizeof(Rgb) == 3);
  png_image png;
  std::memset(&png, 0, sizeof png);
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGB;
  const void* pixels = image.pixels.data();
  const void* colours = nullptr;
  const std::optional<Palette> palette = palette_of(image);
  if (palette) {
    png.format = PNG_FORMAT_RGB_COLORMAP;
    png.colormap_entries = static_cast<png_uint_32>(palette->colours.size());
    pixels = palette->pixels.data();
    colours = palette->colours.data();
  }
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(png), '\0');
  png_alloc_size_t size = bytes.size();
  if (png_image_write_to_memory(&png, bytes.data(), &size, 0, pixels, 0, colours) == 0) {
    const std::string why = png.message;
    png_image_free(&png);
    throw Error("no PNG could be made of the picture: " + why);
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace navjit::picture
