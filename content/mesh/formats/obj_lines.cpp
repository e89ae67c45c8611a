#include "content/mesh/formats/obj_lines.h"

#include <algorithm>
#include <charconv>

namespace ergodome {

namespace {

constexpr std::string_view blanks = " \t\r\v\f";

std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  return text.substr(0, text.find_last_not_of(blanks) + 1);
}

}  // namespace

ObjLines::ObjLines(std::string_view text) : left_(text) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (left_.starts_with(byte_order_mark)) {
    left_.remove_prefix(byte_order_mark.size());
  }
}

bool ObjLines::next() {
  const auto take_line = [&] {
    // Lines of old Macintosh files end with a carriage return alone.
    const std::string_view line = left_.substr(0, left_.find_first_of("\r\n"));
    const std::string_view ending = left_.substr(line.size(), 2);
    left_.remove_prefix(line.size() + (ending == "\r\n" ? 2 : std::min<std::size_t>(ending.size(), 1)));
    ++next_line_;
    return trimmed(line);
  };
  while (!left_.empty()) {
    line_ = next_line_;
    std::string_view line = take_line();
    if (line.empty() || line.front() == '#') {
      continue;
    }
    if (line.back() == '\\') {
      joined_.clear();
      for (; !line.empty() && line.back() == '\\'; line = left_.empty() ? std::string_view() : take_line()) {
        joined_.append(line.substr(0, line.size() - 1)).append(" ");
      }
      joined_.append(line);
      line = trimmed(joined_);
    }
    keyword_ = line.substr(0, line.find_first_of(blanks));
    rest_ = trimmed(line.substr(keyword_.size()));
    return true;
  }
  return false;
}

std::string_view take_word_of(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(blanks));
  text.remove_prefix(word.size());
  return word;
}

bool take_number(std::string_view& text, double& number) {
  std::string_view rest = text;
  std::string_view word = take_word_of(rest);
  word.remove_prefix(word.starts_with('+') ? 1 : 0);
  const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (problem != std::errc() || end != word.data() + word.size()) {
    return false;
  }
  text = rest;
  return true;
}

std::string_view unquoted(std::string_view name) {
  const bool quoted = name.size() >= 2 && (name.front() == '"' || name.front() == '\'') && name.back() == name.front();
  return quoted ? name.substr(1, name.size() - 2) : name;
}

}  // namespace ergodome
