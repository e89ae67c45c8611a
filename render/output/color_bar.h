#pragma once

#include <string>

#include "render/frame/eye_renderer.h"

namespace ergodome {

//! Draws the colour bar of a heat map into its picture: the scale with labelled ticks and a title, at the bottom left. Does nothing for
//! a picture of the sky, and leaves the labels out where the picture is too small to read them or no font is installed.
void draw_color_bar(Picture& picture, ViewMode mode);

//! What a view shows, with its unit.
std::string title_of(ViewMode mode);

}  // namespace ergodome
