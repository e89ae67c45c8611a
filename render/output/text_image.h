#pragma once

#include <string>
#include <vector>

namespace ergodome {

//! Text as a picture of its own: how much of each pixel it covers, 0 to 1, the top row first.
struct TextImage {
  int width = 0;
  int height = 0;
  std::vector<float> coverage;
};

//! Letters as wide as they are, or all of one width, for columns.
enum class TextFace { proportional, monospaced };

//! A line of text, cut out close around it; empty where no font is installed.
TextImage text_image(const std::string& text, int font_px);

//! Lines of any UTF-8 text one below the other, with some room about them; empty where there is nothing to see or no font.
TextImage text_lines_image(const std::string& text, int font_px, TextFace face = TextFace::proportional);

}  // namespace ergodome
