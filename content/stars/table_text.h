#pragma once

#include <istream>
#include <string>
#include <string_view>

#include "content/files/unpacked_stream.h"

namespace ergodome {

//! Reads a table of text as UTF-8, in parts: unpacks gzip, removes byte-order marks, and converts
//! UTF-16 of both byte orders.
class TableText {
 public:
  //! `file` goes into errors. The stream has to outlive this object.
  TableText(std::istream& stream, std::string file);

  //! Returns the next part, empty at the end; valid until the next call. Throws Error for files of
  //! other kinds (VOTable, FITS, workbooks, other compression) with the kind's name, for UTF-32 and
  //! for UTF-16 that is cut off.
  std::string_view next();

 private:
  enum class Encoding { utf8, utf16_little, utf16_big };

  void find_encoding();
  //! Adds the UTF-16 bytes in `raw_` to `text_` as UTF-8; keeps an incomplete unit for the next
  //! part.
  void convert_utf16(bool at_end);
  void add_unit(char32_t unit);

  UnpackedStream bytes_;
  std::string file_;
  bool first_ = true;
  Encoding encoding_ = Encoding::utf8;
  std::string raw_;
  std::string text_;
  char32_t high_surrogate_ = 0;  //!< the first half of a pair whose second half is to come
};

}  // namespace ergodome
