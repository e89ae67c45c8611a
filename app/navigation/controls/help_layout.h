#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace ergodome {

// Layout of lists for monospaced fonts. Cells are separated by tabs, groups of lines by empty
// lines.

//! Lines of text, and the letter height to draw them with.
struct FittedText {
  std::string text;
  int letter_px = 0;
};

struct TextSize {
  int width_px = 0;
  int height_px = 0;

  bool operator==(const TextSize&) const = default;
};

//! Measures a text at a letter height [px].
using MeasureText = std::function<TextSize(const std::string& text, int letter_px)>;

//! Counts the characters of a UTF-8 text: bytes that do not continue one.
std::size_t count_letters(const std::string& text);

//! Lays out a list in one column, or in two side by side, as balanced as whole groups allow. Cells
//! are aligned.
std::string in_columns(const std::string& list, int columns);

//! Lays out a list in two columns (one if it has one group) with the largest letters that fit the
//! window, at most `usual_px` and at least 6; smaller windows crop it.
FittedText fit_list(const std::string& list, const TextSize& window, int usual_px, const MeasureText& measure);

}  // namespace ergodome
