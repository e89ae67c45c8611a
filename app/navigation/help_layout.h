#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace ergodome {

// Lists of lines whose cells are parted by tabs, for letters of one width.

//! Lines of text, and the height of the letters that they are drawn with.
struct FittedText {
  std::string text;
  int letter_px = 0;
};

struct TextSize {
  int width_px = 0;
  int height_px = 0;

  bool operator==(const TextSize&) const = default;
};

//! How large a text is with letters of a height [px].
using MeasureText = std::function<TextSize(const std::string& text, int letter_px)>;

//! Letters of a text in UTF-8: bytes that do not go on with one.
std::size_t count_letters(const std::string& text);

//! A list as `blocks` (>= 1) of as many lines each, beside each other; cells of a block stand below each other.
std::string in_blocks(const std::string& list, int blocks);

//! The list in as many blocks as let its letters be largest in a window: at most `usual_px`, and at least 6, where small windows cut off what
//! then is least. No more blocks than gain something.
FittedText fit_list(const std::string& list, const TextSize& window, int usual_px, const MeasureText& measure);

}  // namespace ergodome
