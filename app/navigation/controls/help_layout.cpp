#include "app/navigation/controls/help_layout.h"

#include <algorithm>
#include <span>
#include <sstream>
#include <utility>
#include <vector>

namespace ergodome {

namespace {

constexpr int min_px = 6;
constexpr std::size_t between_cells = 2;  // characters
constexpr std::size_t between_columns = 4;

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

//! Aligns the lines of one column: pads cells, except the last of a line, to the width of their
//! column. Empty columns take no space.
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

//! Splits a list into groups of lines at empty lines.
std::vector<std::vector<std::string>> groups_of(const std::string& list) {
  std::vector<std::vector<std::string>> groups;
  bool begun = false;
  for (const std::string& line : parts_of(list, '\n')) {
    if (line.empty()) {
      begun = false;
      continue;
    }
    if (!std::exchange(begun, true)) {
      groups.emplace_back();
    }
    groups.back().push_back(line);
  }
  return groups;
}

using Groups = std::span<const std::vector<std::string>>;

//! Joins groups to one column, separated by empty lines.
std::vector<std::string> column_of(Groups groups) {
  std::vector<std::string> lines;
  for (const std::vector<std::string>& group : groups) {
    if (!lines.empty()) {
      lines.emplace_back();
    }
    lines.insert(lines.end(), group.begin(), group.end());
  }
  return lines;
}

//! Returns the number of groups in the first of two columns that minimizes the longer one.
std::size_t first_column(Groups groups) {
  std::size_t best = groups.size();
  std::size_t minimum = column_of(groups).size();
  for (std::size_t i = 1; i < groups.size(); ++i) {
    const std::size_t longer = std::max(column_of(groups.first(i)).size(), column_of(groups.subspan(i)).size());
    if (longer < minimum) {
      best = i;
      minimum = longer;
    }
  }
  return best;
}

}  // namespace

std::size_t count_letters(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string in_columns(const std::string& list, int columns) {
  const std::vector<std::vector<std::string>> groups = groups_of(list);
  const std::size_t first = columns > 1 ? first_column(groups) : groups.size();
  std::vector<std::string> lines = aligned(column_of(Groups(groups).first(first)));
  const std::vector<std::string> second = aligned(column_of(Groups(groups).subspan(first)));
  const std::size_t before = longest_of(lines) + between_columns;
  lines.resize(std::max(lines.size(), second.size()));
  for (std::size_t i = 0; i < second.size(); ++i) {
    if (!second[i].empty()) {
      widen(lines[i], before);
      lines[i] += second[i];
    }
  }
  std::string text;
  for (const std::string& line : lines) {
    text.append(line).append("\n");
  }
  return text;
}

FittedText fit_list(const std::string& list, const TextSize& window, int usual_px, const MeasureText& measure) {
  FittedText fitted = {in_columns(list, 2), min_px};
  // Bisects for the largest letter height at which the text fits the window.
  for (int too_large = usual_px + 1; too_large - fitted.letter_px > 1;) {
    const int between = (fitted.letter_px + too_large) / 2;
    const TextSize size = measure(fitted.text, between);
    const bool fits = size.width_px <= window.width_px && size.height_px <= window.height_px;
    (fits ? fitted.letter_px : too_large) = between;
  }
  return fitted;
}

}  // namespace ergodome
