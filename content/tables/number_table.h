#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ergodome {

//! The cells of one line of a number table.
struct TableLine {
  std::vector<std::string_view> cells;  //!< refer to the table's text; valid until the next line is read
  std::string_view file;                //!< valid as long as the table
  std::size_t number_in_file = 0;       //!< line number, from 1

  //! Returns file and line, for messages.
  [[nodiscard]] std::string location() const;

  //! Returns a cell without surrounding spaces and quotes; empty if the line is too short.
  [[nodiscard]] std::string_view cell(std::size_t column) const {
    return column < cells.size() ? cells[column] : std::string_view{};
  }

  //! Returns the finite number in a cell. Throws Error, which calls it `name`, if the cell does not
  //! contain one.
  [[nodiscard]] double number(std::size_t column, std::string_view name) const;
};

//! Reads a table of numbers line by line: CSV whose first line names the columns. Throws Error for
//! lines above 64 KiB and for more than 50 million rows.
class NumberTable {
 public:
  //! Reads the first line; `file` is the name of the table in messages.
  NumberTable(std::istream& stream, std::string file);

  //! Returns the index of a column by its name, or nothing. Throws Error if two columns have the
  //! name.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view name) const;
  //! Returns the index of a required column. Throws Error if it is missing.
  [[nodiscard]] std::size_t need(std::string_view name) const;

  //! Reads the next nonempty line; returns false at the end. Throws Error if it has nonempty cells
  //! beyond the columns of the first line.
  bool next(TableLine& line);

 private:
  //! Returns the next line without its end, cut after one character more than the maximum; nothing
  //! at the end of the file. The text is valid until the next call.
  std::optional<std::string_view> read_line();

  std::istream& stream_;
  std::string file_;
  std::vector<std::string> names_;
  std::vector<char> block_;  //!< characters read from the stream
  std::size_t begin_ = 0;    //!< first character of `block_` that is not in a line yet
  std::size_t end_ = 0;      //!< end of the characters in `block_`
  std::size_t line_number_ = 1;
  std::size_t rows_ = 0;
};

//! Opens a table file. Throws Error, which describes it as `what` ("a table of rays"), if it cannot
//! be read.
std::ifstream open_table(const std::filesystem::path& path, std::string_view what);

}  // namespace ergodome
