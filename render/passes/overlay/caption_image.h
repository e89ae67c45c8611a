#pragma once

#include <array>
#include <string>

#include "render/passes/overlay/overlay_image.h"

namespace ergodome {

//! How words are set.
struct CaptionType {
  int line_px = 64;                               //!< height of a line
  double width_px = 0.0;                          //!< lines are broken here
  std::array<double, 3> color = {1.0, 1.0, 1.0};  //!< linear light, relative to white
};

//! Words as an image, with a soft dark rim about the letters that keeps them legible before a bright sky. The middle of the image is that
//! of the words.
struct CaptionImage {
  OverlayImage image;      //!< none (width 0) where there is nothing to see
  bool too_large = false;  //!< for longest_overlay_px: none is made
};

//! Sets a text through Pango: any script that a font is installed for, from right to left where it is written so, several lines centred. What is
//! not UTF-8 becomes U+FFFD, and control characters but line ends are left out; more than most_caption_bytes are cut off.
CaptionImage set_caption(const std::string& text, const CaptionType& type);

//! The letters of a text that no installed font has, each once, in their order (UTF-8): they are drawn as boxes.
std::string letters_without_font(const std::string& text);

inline constexpr std::size_t most_caption_bytes = 4096;

}  // namespace ergodome
