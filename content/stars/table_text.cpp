#include "content/stars/table_text.h"

#include <span>
#include <utility>

#include "content/files/whole_file.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

using std::string_view_literals::operator""sv;

constexpr std::size_t text_chunk_bytes = 1U << 18U;
constexpr char32_t replacement_character = 0xFFFD;

//! The signature of a file format that is not a text table.
struct OtherFormat {
  std::string_view magic;
  const char* what;
  const char* remedy;
};

constexpr const char* save_as_csv = "export it as CSV, for example with TOPCAT";

constexpr OtherFormat other_formats[] = {
    {"\x1F\x8B"sv, "is compressed twice (gzip in gzip)", "unpack it once with gunzip"},
    {"BZh"sv, "is compressed (bzip2)", "unpack it with bunzip2"},
    {"\xFD"
     "7zXZ\0"sv,
     "is compressed (xz)", "unpack it with unxz"},
    {"\x28\xB5\x2F\xFD"sv, "is compressed (zstd)", "unpack it with unzstd"},
    {"PK\x03\x04"sv, "is a ZIP archive or a spreadsheet (.xlsx, .ods)", "unpack it, or save the sheet as CSV"},
    {"\xD0\xCF\x11\xE0"sv, "is a spreadsheet (.xls)", "save the sheet as CSV"},
    {"SIMPLE  ="sv, "is a FITS file", save_as_csv},
    {"\x89HDF"sv, "is an HDF5 file", save_as_csv},
    {"PAR1"sv, "is a Parquet file", save_as_csv},
    {"SQLite format 3"sv, "is an SQLite database", save_as_csv},
    {"\xFF\xFE\0\0"sv, "is text in UTF-32", "save it as UTF-8"},
    {"\0\0\xFE\xFF"sv, "is text in UTF-32", "save it as UTF-8"},
    {"{"sv, "is JSON, not a table with one row per line", save_as_csv},
    {"[{"sv, "is JSON, not a table with one row per line", save_as_csv},
};

//! Throws Error if a file begins with the signature of another format.
void require_table_of_text(std::string_view begin, const std::string& file) {
  for (const OtherFormat& format : other_formats) {
    if (begin.starts_with(format.magic)) {
      throw Error(file, format.what, format.remedy);
    }
  }
  if (begin.size() > 262 && begin.substr(257, 5) == "ustar") {
    throw Error(file, "is a tar archive", "unpack it with tar");
  }
  const std::string_view text = begin.starts_with("\xEF\xBB\xBF") ? begin.substr(3) : begin;
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != std::string_view::npos && text[first] == '<') {
    const bool votable = text.substr(0, 4096).find("VOTABLE") != std::string_view::npos;
    throw Error(file, votable ? "is a VOTable (XML)" : "is XML or HTML, not a text table",
                votable ? save_as_csv : "download the table itself, as CSV or TSV");
  }
}

//! Throws Error if the first line contains zero bytes, which UTF-8 text never has.
void require_no_binary_file(std::string_view begin, const std::string& file) {
  if (begin.substr(0, begin.find_first_of("\r\n")).substr(0, 4096).find('\0') != std::string_view::npos) {
    throw Error(file, "is a binary file, not a text table", save_as_csv);
  }
}

void append_utf8(std::string& text, char32_t c) {
  const auto add = [&](char32_t byte) { text += static_cast<char>(static_cast<unsigned char>(byte)); };
  if (c < 0x80) {
    add(c);
  } else if (c < 0x800) {
    add(0xC0 | (c >> 6U));
    add(0x80 | (c & 0x3FU));
  } else if (c < 0x10000) {
    add(0xE0 | (c >> 12U));
    add(0x80 | ((c >> 6U) & 0x3FU));
    add(0x80 | (c & 0x3FU));
  } else {
    add(0xF0 | (c >> 18U));
    add(0x80 | ((c >> 12U) & 0x3FU));
    add(0x80 | ((c >> 6U) & 0x3FU));
    add(0x80 | (c & 0x3FU));
  }
}

}  // namespace

TableText::TableText(std::istream& stream, std::string file) : bytes_(stream, file), file_(std::move(file)) {}

std::string_view TableText::next() {
  do {
    throw_if_reading_stopped(file_);
    const std::size_t kept = raw_.size();
    raw_.resize(kept + text_chunk_bytes);
    const std::size_t count = bytes_.read(std::span(raw_).subspan(kept));
    raw_.resize(kept + count);
    if (first_) {
      find_encoding();
      first_ = false;
    }
    text_.clear();
    if (encoding_ == Encoding::utf8) {
      text_.swap(raw_);
    } else {
      convert_utf16(count == 0);
    }
    if (count == 0) {
      break;
    }
  } while (text_.empty());
  return text_;
}

void TableText::find_encoding() {
  require_table_of_text(raw_, file_);
  // Without a byte-order mark, the first two characters decide: column names are Latin letters,
  // whose high byte is 0.
  const auto zero = [&](std::size_t i) { return raw_[i] == '\0'; };
  const bool letters = raw_.size() >= 4;
  if (raw_.starts_with("\xFF\xFE") || (letters && !zero(0) && zero(1) && !zero(2) && zero(3))) {
    encoding_ = Encoding::utf16_little;
  } else if (raw_.starts_with("\xFE\xFF") || (letters && zero(0) && !zero(1) && zero(2) && !zero(3))) {
    encoding_ = Encoding::utf16_big;
  }
  if (encoding_ == Encoding::utf8) {
    require_no_binary_file(raw_, file_);
    if (raw_.starts_with("\xEF\xBB\xBF")) {
      raw_.erase(0, 3);
    }
  } else if (raw_.starts_with("\xFF\xFE") || raw_.starts_with("\xFE\xFF")) {
    raw_.erase(0, 2);
  }
}

void TableText::convert_utf16(bool at_end) {
  const std::size_t low = encoding_ == Encoding::utf16_little ? 0 : 1;
  std::size_t i = 0;
  for (; i + 1 < raw_.size(); i += 2) {
    const auto byte = [&](std::size_t at) { return static_cast<char32_t>(static_cast<unsigned char>(raw_[at])); };
    add_unit(byte(i + low) | (byte(i + 1 - low) << 8U));
  }
  raw_.erase(0, i);
  if (at_end && (!raw_.empty() || high_surrogate_ != 0)) {
    throw Error(file_, "is truncated within a character (UTF-16)", "copy or download it again");
  }
}

void TableText::add_unit(char32_t unit) {
  const bool low_half = unit >= 0xDC00 && unit < 0xE000;
  if (high_surrogate_ != 0) {
    const char32_t high = std::exchange(high_surrogate_, 0);
    if (low_half) {
      return append_utf8(text_, 0x10000 + ((high - 0xD800) << 10U) + (unit - 0xDC00));
    }
    append_utf8(text_, replacement_character);
  }
  if (unit >= 0xD800 && unit < 0xDC00) {
    high_surrogate_ = unit;
  } else {
    append_utf8(text_, low_half ? replacement_character : unit);
  }
}

}  // namespace ergodome
