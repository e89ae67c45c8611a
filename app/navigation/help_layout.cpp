#include "app/navigation/help_layout.h"

#include <algorithm>
#include <sstream>
#include <vector>

namespace ergodome {

namespace {

constexpr int most_blocks = 4;
constexpr int least_px = 6;
constexpr std::size_t between_cells = 2;  // letters
constexpr std::size_t between_blocks = 3;

std::vector<std::string> parts_of(const std::string& text, char end) {
  std::vector<std::string> parts;
  std::stringstream stream(text);
  for (std::string part; std::getline(stream, part, end);) {
    parts.push_back(part);
  }
  return parts;
}

std::size_t longest_of(const std::vector<std::string>& lines) {
  std::size_t longest = 0;
  for (const std::string& line : lines) {
    longest = std::max(longest, count_letters(line));
  }
  return longest;
}

void widen(std::string& line, std::size_t letters) {
  line.append(letters - std::min(letters, count_letters(line)), ' ');
}

//! Lines of one block: its cells filled up to the longest of their column, but for the last of a line; empty columns take no room.
std::vector<std::string> aligned(const std::vector<std::string>& lines) {
  std::vector<std::vector<std::string>> rows;
  std::vector<std::size_t> widths;
  for (const std::string& line : lines) {
    rows.push_back(parts_of(line, '\t'));
    widths.resize(std::max(widths.size(), rows.back().size()));
    for (std::size_t i = 0; i < rows.back().size(); ++i) {
      widths[i] = std::max(widths[i], count_letters(rows.back()[i]));
    }
  }
  std::vector<std::string> all;
  for (const std::vector<std::string>& cells : rows) {
    std::string line;
    std::size_t end = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      widen(line, end);
      line += cells[i];
      end += widths[i] > 0 ? widths[i] + between_cells : 0;
    }
    all.push_back(std::move(line));
  }
  return all;
}

}  // namespace

std::size_t count_letters(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string in_blocks(const std::string& list, int blocks) {
  const std::vector<std::string> lines = parts_of(list, '\n');
  const std::size_t columns = std::max<std::size_t>(1, static_cast<std::size_t>(blocks));
  const std::size_t rows = (lines.size() + columns - 1) / columns;
  std::vector<std::string> all(rows);
  for (std::size_t first = 0; first < lines.size(); first += rows) {
    const auto begin = lines.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = lines.begin() + static_cast<std::ptrdiff_t>(std::min(first + rows, lines.size()));
    const std::vector<std::string> block = aligned({begin, end});
    const std::size_t before = first > 0 ? longest_of(all) + between_blocks : 0;
    for (std::size_t i = 0; i < block.size(); ++i) {
      widen(all[i], before);
      all[i] += block[i];
    }
  }
  std::string text;
  for (const std::string& line : all) {
    text.append(line).append("\n");
  }
  return text;
}

FittedText fit_list(const std::string& list, const TextSize& window, int usual_px, const MeasureText& measure) {
  FittedText best;
  FittedText least;
  double least_part = 0.0;
  for (int blocks = 1; blocks <= most_blocks && best.letter_px < usual_px; ++blocks) {
    const std::string laid = in_blocks(list, blocks);
    const auto part_of_window = [&](int letter_px) {
      const TextSize size = measure(laid, letter_px);
      return std::max(static_cast<double>(size.width_px) / window.width_px,
                      static_cast<double>(size.height_px) / window.height_px);
    };
    // The largest that fits, by halves; the smallest where none does.
    int letter_px = std::max(best.letter_px, least_px);
    for (int too_large = usual_px + 1; too_large - letter_px > 1;) {
      const int between = (letter_px + too_large) / 2;
      (part_of_window(between) <= 1.0 ? letter_px : too_large) = between;
    }
    const double part = part_of_window(letter_px);
    if (part <= 1.0 && letter_px > best.letter_px) {
      best = {laid, letter_px};
    } else if (letter_px == least_px && (least.letter_px == 0 || part < least_part)) {
      least = {laid, least_px};
      least_part = part;
    }
  }
  return best.letter_px > 0 ? best : least;
}

}  // namespace ergodome
