// Reads PNG files by libpng.
#pragma once

#include <png.h>

#include <cstring>
#include <stdexcept>
#include <string>

#include "apps/picture/image.hpp"

namespace navjit::tests {

/// Throws if it is no PNG file.
inline picture::Image decode_png(const std::string& bytes) {
  png_image png;
  std::memset(&png, 0, sizeof png);
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) {
    throw std::runtime_error(std::string("no PNG: ") + png.message);
  }
  png.format = PNG_FORMAT_RGB;
  picture::Image image(static_cast<int>(png.width), static_cast<int>(png.height), {});
  if (png_image_finish_read(&png, nullptr, image.pixels.data(), 0, nullptr) == 0) {
    throw std::runtime_error(std::string("bad PNG: ") + png.message);
  }
  return image;
}

}  // namespace navjit::tests
