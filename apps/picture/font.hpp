// Text in pictures of pixels: letters of five by seven, larger by whole factors.
#pragma once

#include <string_view>

#include "apps/picture/image.hpp"

namespace navjit::picture {

constexpr int letter_width = 6, letter_height = 9;  ///< with the space to the next

/// Draws printable ASCII, and ? for each other byte; (x, y) is the top left. What is beyond the
/// picture's edge is left out.
void draw_text(Image& image, int x, int y, int factor, Rgb colour, std::string_view text);

/// A filled rectangle, as far as it is in the picture.
void fill(Image& image, int x, int y, int width, int height, Rgb colour);

}  // namespace navjit::picture
