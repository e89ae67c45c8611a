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

//! The size of text_lines_image() [px], without drawing it; 0 where that is empty.
struct TextLinesSize {
  int width = 0;
  int height = 0;
};
TextLinesSize text_lines_size(const std::string& text, int font_px, TextFace face = TextFace::proportional,
                              int widest_px = 0);

//! Lines of any UTF-8 text one below the other, with some room about them; empty where there is nothing to see or no font. `widest_px`: no
//! image is wider; longer lines go on in the next, between words or, where one is too long, within it. 0: as wide as the lines are.
TextImage text_lines_image(const std::string& text, int font_px, TextFace face = TextFace::proportional,
                           int widest_px = 0);

}  // namespace ergodome
