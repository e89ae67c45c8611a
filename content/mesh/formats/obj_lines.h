#pragma once

#include <string>
#include <string_view>

namespace ergodome {

//! Iterates over the statements of a Wavefront OBJ or MTL file. Skips comments, empty lines and a
//! byte-order mark, and joins lines that end with a backslash to the next one.
class ObjLines {
 public:
  //! `text` must outlive this object.
  explicit ObjLines(std::string_view text);

  //! Goes to the next statement; returns false at the end.
  bool next();

  [[nodiscard]] std::string_view keyword() const { return keyword_; }
  //! Returns the text after the keyword, without surrounding blanks.
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

//! Removes and returns the next word of a text, up to a blank; empty at the end.
std::string_view take_word_of(std::string_view& text);

//! Removes the next word of a text and parses it as a number. Returns false, and leaves the text
//! unchanged, unless the whole word is a number.
bool take_number(std::string_view& text, double& number);

//! Removes the quotes that some programs write around a name.
std::string_view unquoted(std::string_view name);

}  // namespace ergodome
