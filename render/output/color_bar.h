#pragma once

#include <string>
#include <vector>

#include "render/frame/eye_renderer.h"

namespace ergodome {

//! Words of a colour bar, with the middle of their upper edge [px].
struct BarText {
  std::string text;
  int middle_x;
  int top_y;
};

//! Where the colour bar of a heat map and its words are, in pixels from the top left.
struct ColorBarLayout {
  int left, top, width, height;
  int letter_px;
  std::vector<BarText>
      texts;  //!< numbers from the left, then the title; fewer, or a shorter title, where there is no room
};

//! The layout for a picture: in its left half, below the middle, with letters that can be read (9 px and more) and do not touch. Without width where the picture is
//! too small for that.
ColorBarLayout color_bar_layout(int width_px, int height_px, const HeatRange& range, ViewMode mode);

//! Whether a picture is large enough for a colour bar.
bool has_color_bar(int width_px, int height_px);

//! The part of a picture's height, from its lower edge, that a colour bar and its words take; 0 where it is too small for one.
double color_bar_part(int width_px, int height_px);

//! Draws the colour bar of a heat map into its picture: the scale with labelled ticks and a title, at the bottom left. Does nothing for
//! a picture of the sky and for one that is too small, and leaves the labels out where no font is installed.
void draw_color_bar(Picture& picture, ViewMode mode);

}  // namespace ergodome
