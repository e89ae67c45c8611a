#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace ergodome {

// Lists of lines whose cells are parted by tabs, and whose groups are parted by empty lines, for letters of one width.

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

//! A list in one column, or in two beside each other, as equally long as whole groups allow. Cells of a column stand below each other.
std::string in_columns(const std::string& list, int columns);

//! The list in two columns (one, if it is one group), with letters as large as fit into a window: at most `usual_px`, and at least 6, where smaller windows
//! cut it off.
FittedText fit_list(const std::string& list, const TextSize& window, int usual_px, const MeasureText& measure);

}  // namespace ergodome
