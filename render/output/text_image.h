#pragma once

#include <string>
#include <vector>

// Draws text into images, and the dark rim around letters.

namespace ergodome {

//! Text as an image of its coverage, 0 to 1 per pixel, top row first.
struct TextImage {
  int width = 0;
  int height = 0;
  std::vector<float> coverage;
};

//! Proportional letters, or letters of one width for columns.
enum class TextFace { proportional, monospaced };

//! Draws a line of text, cropped to the letters; empty if no font is installed.
TextImage text_image(const std::string& text, int font_px);

//! Size of the result of text_lines_image() [px], computed without drawing; 0 if that is empty.
struct TextLinesSize {
  int width = 0;
  int height = 0;
};
TextLinesSize text_lines_size(const std::string& text, int font_px, TextFace face = TextFace::proportional,
                              int widest_px = 0);

//! Draws lines of UTF-8 text below each other, with a margin of half of `font_px`. Empty without
//! visible text or a font, or if the lines are wider or higher than 8192 px. `widest_px` limits the
//! width: longer lines are wrapped between words, or within a word that is too long. 0: no limit.
TextImage text_lines_image(const std::string& text, int font_px, TextFace face = TextFace::proportional,
                           int widest_px = 0);

//! Returns how far the dark rim around letters extends [px] for a line height [px]: at least 2.
int text_rim_reach_px(int line_px);

//! Returns the darkness of the rim around letters at each pixel, 0 to 1: dark beside the letters,
//! fading outwards. `coverage`: of the letters, row by row; the image must have a margin of
//! `reach_px` around them.
std::vector<float> text_rim(const std::vector<float>& coverage, int width, int height, int reach_px);

}  // namespace ergodome
