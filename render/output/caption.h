#pragma once

#include <string>

#include "render/frame/eye_renderer.h"

namespace ergodome {

//! Writes lines of text into the top left corner of a picture, which a dome leaves black. Does nothing where the picture is too small to
//! read them, or no font is installed.
void draw_caption(Picture& picture, const std::string& text);

}  // namespace ergodome
