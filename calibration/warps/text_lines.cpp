#include "calibration/warps/text_lines.h"

#include <charconv>
#include <string>

namespace ergodome {

namespace {

bool is_blank(char c) { return static_cast<unsigned char>(c) <= 0x20 || c == 0x7f; }

template <class T>
std::optional<T> parsed(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') {
    word.remove_prefix(1);
  }
  T value{};
  const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (problem != std::errc() || end != word.data() + word.size()) {
    return std::nullopt;
  }
  return value;
}

}  // namespace

TextLines::TextLines(std::string_view text) : rest_(text) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (rest_.starts_with(byte_order_mark)) {
    rest_.remove_prefix(byte_order_mark.size());
  }
}

std::optional<std::string_view> TextLines::next() {
  while (!rest_.empty()) {
    const std::size_t end = rest_.find_first_of("\r\n");
    const std::string_view line = rest_.substr(0, end);
    std::size_t used = line.size();
    if (end != std::string_view::npos) {
      used += rest_.substr(end).starts_with("\r\n") ? 2 : 1;
    }
    rest_.remove_prefix(used);
    ++number_;
    for (const char c : line) {
      if (!is_blank(c)) {
        return line;
      }
    }
  }
  return std::nullopt;
}

std::string_view take_word(std::string_view& line) {
  std::size_t begin = 0;
  while (begin < line.size() && is_blank(line[begin])) {
    ++begin;
  }
  std::size_t end = begin;
  while (end < line.size() && !is_blank(line[end])) {
    ++end;
  }
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

std::optional<double> number_of(std::string_view word) { return parsed<double>(word); }

std::optional<long long> whole_number_of(std::string_view word) { return parsed<long long>(word); }

std::optional<double> decimal_of(std::string_view word) {
  constexpr std::size_t longest = 64;
  const std::size_t comma = word.find(',');
  if (comma == std::string_view::npos || word.size() > longest) {
    return number_of(word);
  }
  std::string with_point(word);
  with_point[comma] = '.';
  return with_point.find(',') == std::string::npos && word.find('.') == std::string_view::npos ? number_of(with_point)
                                                                                               : std::nullopt;
}

}  // namespace ergodome
