#pragma once

#include <string>
#include <string_view>

namespace ergodome {

//! Walks through the statements of a Wavefront OBJ or MTL file. Comments and empty lines are left out, lines that end with a
//! backslash go on in the next one, and a byte-order mark is skipped.
class ObjLines {
 public:
  //! `text` must outlive this.
  explicit ObjLines(std::string_view text);

  //! Goes to the next statement; false where there is none.
  bool next();

  [[nodiscard]] std::string_view keyword() const { return keyword_; }
  //! What follows the keyword, without blanks at its ends.
  [[nodiscard]] std::string_view rest() const { return rest_; }
  [[nodiscard]] long line() const { return line_; }

 private:
  std::string_view left_;
  std::string joined_;
  std::string_view keyword_;
  std::string_view rest_;
  long line_ = 0;
  long next_line_ = 1;
};

//! Takes the next word, up to a blank, from the beginning of a text; empty where there is none.
std::string_view take_word_of(std::string_view& text);

//! Takes the next word if it is a number as a whole.
bool take_number(std::string_view& text, double& number);

//! A name without the quotes that some programs write around it.
std::string_view unquoted(std::string_view name);

}  // namespace ergodome
