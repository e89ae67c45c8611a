#pragma once

#include <array>
#include <string>

#include "render/passes/overlay/overlay_image.h"

namespace ergodome {

//! Size and color of a caption's letters.
struct CaptionType {
  int line_px = 64;                               //!< height of a line [px]
  double width_px = 0.0;                          //!< width at which lines break [px]
  std::array<double, 3> color = {1.0, 1.0, 1.0};  //!< linear light, relative to white
};

//! A text as an image, with a soft dark rim around the letters to keep them legible on a bright
//! sky. The text is centered in the image.
struct CaptionImage {
  OverlayImage image;      //!< width 0 if there is nothing to see
  bool too_large = false;  //!< exceeds longest_overlay_px, so there is no image
};

//! Draws a text with Pango: centered lines in any script for which a font is installed, including
//! right to left. Invalid UTF-8 becomes U+FFFD; control characters except line breaks and tabs are
//! removed. Truncates texts after max_caption_bytes.
CaptionImage set_caption(const std::string& text, const CaptionType& type);

//! Returns the letters of a text that no installed font contains, each once, in their order
//! (UTF-8). They are drawn as boxes.
std::string letters_without_font(const std::string& text);

inline constexpr std::size_t max_caption_bytes = 4096;

}  // namespace ergodome
