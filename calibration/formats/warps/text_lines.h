#pragma once

#include <optional>
#include <string_view>

namespace ergodome {

//! Splits a text into lines that end in LF, CR LF or CR, passes over those that hold nothing but blanks, and counts all of them.
class TextLines {
 public:
  explicit TextLines(std::string_view text);

  //! The next line that holds something; nothing at the end of the text.
  std::optional<std::string_view> next();

  //! The number of the line that next() gave last, from 1; after the end, that of the last line.
  [[nodiscard]] int number() const { return number_; }

 private:
  std::string_view rest_;
  int number_ = 0;
};

//! Takes the next word, of characters that are neither blank nor control, from the front of a line; empty when there is none.
std::string_view take_word(std::string_view& line);

//! The number that a whole word is, independent of locale; nothing for anything else. NaN and infinities are numbers here.
std::optional<double> number_of(std::string_view word);
std::optional<long long> whole_number_of(std::string_view word);

//! Parses a number as number_of() does; also accepts a decimal comma, which programs write in some countries.
std::optional<double> decimal_of(std::string_view word);

}  // namespace ergodome
