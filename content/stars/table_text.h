#pragma once

#include <istream>
#include <string>
#include <string_view>

#include "content/files/unpacked_stream.h"

namespace ergodome {

//! Reads a text table as UTF-8, in parts: decompresses gzip, removes byte-order marks, and converts
//! UTF-16 of both byte orders.
class TableText {
 public:
  //! `file` is the name in messages. The stream must outlive this object.
  TableText(std::istream& stream, std::string file);

  //! Returns the next part, valid until the next call; empty at the end. Throws Error for other
  //! file formats (VOTable, FITS, workbooks, other compression) with their name, for UTF-32, and
  //! for truncated UTF-16.
  std::string_view next();

 private:
  enum class Encoding { utf8, utf16_little, utf16_big };

  void find_encoding();
  //! Appends the UTF-16 bytes in `raw_` to `text_` as UTF-8; keeps an incomplete unit for the next
  //! part.
  void convert_utf16(bool at_end);
  void add_unit(char32_t unit);

  UnpackedStream bytes_;
  std::string file_;
  bool first_ = true;
  Encoding encoding_ = Encoding::utf8;
  std::string raw_;
  std::string text_;
  char32_t high_surrogate_ = 0;  //!< first half of a pair whose second half has not been read
};

}  // namespace ergodome
