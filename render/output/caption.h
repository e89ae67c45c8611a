#pragma once

#include <string>
#include <vector>

#include "render/frame/eye_renderer.h"

namespace ergodome {

//! Writes lines of text into the top left corner of a picture, which a dome leaves black. Does nothing where the picture is too small to
//! read them, or no font is installed.
void draw_caption(Picture& picture, const std::string& text);

//! Text as a picture of its own: how much of each pixel it covers, 0 to 1, the top row first.
struct TextImage {
  int width = 0;
  int height = 0;
  std::vector<float> coverage;
};

//! A line of text, cut out close around it; empty where no font is installed.
TextImage text_image(const std::string& text, int font_px);

//! Lines of text one below the other on common lines, with some room about them; empty where no font is installed.
TextImage text_lines_image(const std::string& text, int font_px);

}  // namespace ergodome
