#include "content/stars/star_table.h"

#include <csv.h>

#include <algorithm>
#include <fstream>
#include <new>
#include <optional>
#include <string_view>
#include <utility>

#include "content/stars/column_names.h"
#include "content/stars/table_builder.h"
#include "content/stars/table_text.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

constexpr std::size_t longest_cell = 65'536;
//! Maximum length of the header and of the lines before it [bytes]. Longer ones are processed as if
//! they ended there.
constexpr std::size_t longest_kept_line = 1U << 20U;
constexpr std::size_t max_described_columns = 4096;

//! Owns a libcsv parser.
class CsvParser {
 public:
  CsvParser() {
    if (csv_init(&parser_, CSV_REPALL_NL) != 0) {
      throw std::bad_alloc();
    }
  }
  ~CsvParser() { csv_free(&parser_); }
  CsvParser(const CsvParser&) = delete;
  CsvParser& operator=(const CsvParser&) = delete;

  void set_separator(char separator) { csv_set_delim(&parser_, static_cast<unsigned char>(separator)); }

  void parse(std::string_view text, TableBuilder& table) {
    if (csv_parse(&parser_, text.data(), text.size(), &take_cell, &end_row, &table) != text.size()) {
      table.fail(csv_strerror(csv_error(&parser_)), "write comma-separated values");
    }
    // Limits the size of a cell: a quote that is never closed would include the rest of the file in
    // one.
    if (csv_get_buffer_size(&parser_) > longest_cell) {
      table.fail("has a cell of more than 64 KiB", "close its quotation marks");
    }
  }

  void finish(TableBuilder& table) {
    // Strict checks apply only at the end of the file, so that a quote within an unquoted cell is
    // allowed.
    csv_set_opts(&parser_, CSV_REPALL_NL | CSV_STRICT | CSV_STRICT_FINI);
    if (csv_fini(&parser_, &take_cell, &end_row, &table) != 0) {
      table.fail("has a quotation mark that is never closed", "close it");
    }
  }

 private:
  static void take_cell(void* cell, std::size_t length, void* table) {
    static_cast<TableBuilder*>(table)->take_cell({static_cast<const char*>(cell), cell != nullptr ? length : 0});
  }
  static void end_row(int end, void* table) { static_cast<TableBuilder*>(table)->end_row(end); }

  csv_parser parser_{};
};

//! Returns the character between the cells of a header: the most frequent of comma, semicolon, tab
//! and bar, or otherwise a space.
char separator_of(std::string_view header) {
  char maximum = ',';
  for (const char separator : {';', '\t', '|'}) {
    maximum = std::ranges::count(header, separator) > std::ranges::count(header, maximum) ? separator : maximum;
  }
  return header.find(maximum) == std::string_view::npos && header.find(' ') != std::string_view::npos ? ' ' : maximum;
}

std::string_view without_blanks(std::string_view line) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t first = line.find_first_not_of(blanks);
  return first == std::string_view::npos ? "" : line.substr(first, line.find_last_not_of(blanks) - first + 1);
}

//! Returns the value of a key in a comment of an ECSV file: `# - {name: ra, unit: deg, datatype:
//! float64}`.
std::string_view ecsv_value(std::string_view comment, std::string_view key) {
  const std::size_t at = comment.find(key);
  if (at == std::string_view::npos) {
    return "";
  }
  const std::string_view rest = comment.substr(at + key.size());
  const std::string_view value = without_blanks(rest.substr(0, rest.find_first_of(",}")));
  return value.size() > 1 && (value.front() == '"' || value.front() == '\'') ? value.substr(1, value.size() - 2)
                                                                             : value;
}

//! Splits a text into lines: skips comments, finds the header, and passes the rest to the CSV
//! parser.
class TableLines {
 public:
  explicit TableLines(std::string file) : file_(std::move(file)), table_(file_) {}

  void take(std::string_view text) {
    while (!text.empty()) {
      const std::size_t end = text.find_first_of("\r\n");
      const std::string_view piece = text.substr(0, end == std::string_view::npos ? end : end + 1);
      text.remove_prefix(piece.size());
      take_piece(piece, end != std::string_view::npos);
    }
    table_.check();
  }

  StarCatalogue finish() {
    if (!header_found_ && !kept_.empty()) {
      take_line_before_rows();
    }
    parser_.finish(table_);
    return table_.finish();
  }

 private:
  //! Processes a line, or a piece of a line that continues in the next part of the text.
  void take_piece(std::string_view piece, bool ended) {
    if (!header_found_) {
      kept_ += piece;
      if (ended || kept_.size() > longest_kept_line) {
        take_line_before_rows();
        kept_.clear();
      }
      return;
    }
    if (at_line_start_ && table_.is_between_rows()) {
      in_comment_ = piece.front() == '#';
    }
    at_line_start_ = ended;
    if (!in_comment_) {
      return parse(piece);
    }
    if (ended) {
      table_.skip_line(piece.back());
      in_comment_ = false;
    }
  }

  void take_line_before_rows() {
    const std::string_view line = without_blanks(kept_);
    if (line.starts_with('#')) {
      note_comment(line);
      return table_.skip_line(kept_.back());
    }
    if (line.starts_with("sep=") && line.size() == 5) {
      declared_separator_ = line[4];
      return table_.skip_line(kept_.back());
    }
    if (line.empty() && kept_.find('\t') == std::string::npos) {
      return table_.skip_line(kept_.back());
    }
    begin_table(line);
  }

  //! Begins the table with the first line that is not a comment: the header, or data whose header
  //! is the last comment.
  void begin_table(std::string_view line) {
    const std::size_t first = line.find_first_not_of("\" ");
    const bool data = first != std::string_view::npos &&
                      (std::string_view("+-.0123456789").find(line[first]) != std::string_view::npos);
    if (data && last_comment_.empty()) {
      throw Error(file_, "has no column names: its first line begins with a number",
                  "name the columns in the first line; convert a fixed-width table to CSV first");
    }
    const std::string header = data ? last_comment_ : std::string(line);
    separator_ = declared_separator_.value_or(separator_of(header));
    parser_.set_separator(separator_);
    table_.begin(separator_, std::move(units_));
    header_found_ = true;
    if (data) {
      // The line of this header was already counted as a comment. Ending the row with a carriage
      // return does not count it again.
      parse(header + '\r');
    }
    at_line_start_ = kept_.ends_with('\n') || kept_.ends_with('\r');
    parse(kept_);
  }

  void note_comment(std::string_view comment) {
    comment.remove_prefix(std::min(comment.find_first_not_of("# \t"), comment.size()));
    if (const std::string_view name = ecsv_value(comment, "name: "); !name.empty()) {
      const std::string_view unit = ecsv_value(comment, "unit: ");
      if (!unit.empty() && units_.size() < max_described_columns) {
        units_.emplace(plain_column_name(name), unit);
      }
    }
    last_comment_ = comment;
  }

  void parse(std::string_view text) {
    if (separator_ != ' ') {
      table_.begin_row();
      return parser_.parse(text, table_);
    }
    std::string single;
    for (const char c : text) {
      add_with_single_spaces(c, single);
    }
    if (!single.empty()) {
      table_.begin_row();
      parser_.parse(single, table_);
    }
  }

  //! Appends a character of the file to `text`. Outside quotes, several spaces and tabs between
  //! cells become a single space, and those at both ends of a line are dropped.
  void add_with_single_spaces(char c, std::string& text) {
    const bool line_end = c == '\n' || c == '\r';
    if (!in_quotes_ && (c == ' ' || c == '\t')) {
      space_waits_ = in_line_;
      return;
    }
    if (space_waits_ && !line_end) {
      text += ' ';
    }
    space_waits_ = false;
    in_line_ = in_quotes_ || !line_end;
    in_quotes_ = in_quotes_ != (c == '"');
    text += c;
  }

  std::string file_;
  TableBuilder table_;
  CsvParser parser_;
  char separator_ = ',';
  std::optional<char> declared_separator_;  //!< separator stated in a spreadsheet's line `sep=`
  std::string kept_;                        //!< beginning of an incomplete line before the rows
  std::string last_comment_;
  UnitsByName units_;
  bool header_found_ = false;
  bool at_line_start_ = true;
  bool in_comment_ = false;
  bool in_quotes_ = false;  //!< true within quotes; used if spaces separate cells
  //! True if the line already has a cell; used if spaces separate cells.
  bool in_line_ = false;
  //! True if a space must precede the next cell; used if spaces separate cells.
  bool space_waits_ = false;
};

}  // namespace

StarCatalogue parse_star_table(std::istream& stream, const std::string& file) {
  TableText text(stream, file);
  TableLines lines(file);
  for (std::string_view part = text.next(); !part.empty(); part = text.next()) {
    lines.take(part);
  }
  return lines.finish();
}

StarCatalogue read_star_table(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    throw Error(path.string(), "cannot be opened", "check the path and its permissions");
  }
  return parse_star_table(stream, path.string());
}

}  // namespace ergodome
