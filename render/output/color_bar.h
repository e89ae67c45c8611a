#pragma once

#include <string>
#include <vector>

#include "render/picture/picture.h"

// Draws the color bar of a heat map.

namespace ergodome {

//! A text of a color bar, and the position of the middle of its upper edge [px].
struct BarText {
  std::string text;
  int middle_x;
  int top_y;
};

//! Positions of a heat map's color bar and its texts, in pixels from the top left.
struct ColorBarLayout {
  int left, top, width, height;
  int letter_px;
  //! Labels of the scale from the left, then the title. If there is not enough room, there are
  //! fewer labels or none, and the title is shorter or absent.
  std::vector<BarText> texts;
};

//! Computes the layout of a color bar for a picture: in the lower left quarter, with readable
//! letters (at least 9 px) that do not overlap. The width is 0 if the picture is too small.
ColorBarLayout color_bar_layout(int width_px, int height_px, const HeatRange& range, ViewMode mode);

//! Returns whether a picture is large enough for a color bar.
bool has_color_bar(int width_px, int height_px);

//! Returns the height that a color bar and its texts take, from the picture's lower edge, as a
//! fraction of the picture's height; 0 if the picture is too small.
double color_bar_part(int width_px, int height_px);

//! Draws the color bar of a heat map into its picture: the scale with labeled ticks and a title, at
//! the bottom left. Does nothing for pictures of the sky and for small ones. Omits the labels if no
//! font is installed.
void draw_color_bar(Picture& picture, ViewMode mode);

}  // namespace ergodome
