#pragma once

#include <optional>
#include <string_view>

namespace ergodome {

//! Splits a text into lines that end in LF, CR LF or CR. Skips blank lines, but counts them.
class TextLines {
 public:
  explicit TextLines(std::string_view text);

  //! Returns the next line that is not blank; nothing at the end.
  std::optional<std::string_view> next();

  //! Returns the number, from 1, of the line that next() returned last; after the end, that of the
  //! last line.
  [[nodiscard]] int number() const { return number_; }

 private:
  std::string_view rest_;
  int number_ = 0;
};

//! Removes and returns the next word, of characters that are neither blank nor control, from the
//! front of a line; empty if there is none.
std::string_view take_word(std::string_view& line);

//! Parses a whole word as a number, independent of the locale; returns nothing for anything else.
//! Accepts NaN and infinities.
std::optional<double> number_of(std::string_view word);
std::optional<long long> whole_number_of(std::string_view word);

//! Parses a number as number_of() does; also accepts a decimal comma, which some programs write in
//! some locales.
std::optional<double> decimal_of(std::string_view word);

}  // namespace ergodome
